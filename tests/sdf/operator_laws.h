#pragma once
// What every evaluated row of operators() promises, as functions that look for a violation.
#include "sdf/draw.h"

#include <span>
#include <string>
#include <string_view>

namespace mb {

struct OperatorLaw {
    std::string_view name;
    std::string (*violation)(const Operator&, Draw&);  // what is wrong; empty: nothing was found
};
std::span<const OperatorLaw> operatorLaws();

}  // namespace mb
