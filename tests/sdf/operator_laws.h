#pragma once
// What every row of operators() that folds two distances promises, as functions that look for a violation.
#include "sdf/draw.h"

#include <span>
#include <string>
#include <string_view>

namespace mb {

struct OperatorLaw {
    std::string_view name;
    std::string (*violation)(const Operator&, Draw&);  // what is wrong; empty: nothing was found
    bool of_blends = false;                            // only of rows whose number is a blend
};
std::span<const OperatorLaw> operatorLaws();

}  // namespace mb
