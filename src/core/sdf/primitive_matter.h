#pragma once
// How much matter a primitive holds and how it lies, in closed form: one function a row of primitives(), from the row's
// cooked numbers. A whole shape's are in physics/mass_properties.h.
#include "core/sdf/shape.h"

namespace mb {

std::optional<Matter> sphereMatter(const LeafNumbers& k);
std::optional<Matter> boxMatter(const LeafNumbers& k);
std::optional<Matter> torusMatter(const LeafNumbers& k);  // nothing where the tube is thicker than its ring
std::optional<Matter> cylinderMatter(const LeafNumbers& k);
std::optional<Matter> capsuleMatter(const LeafNumbers& k);
std::optional<Matter> coneMatter(const LeafNumbers& k);
std::optional<Matter> ellipsoidMatter(const LeafNumbers& k);
std::optional<Matter> octahedronMatter(const LeafNumbers& k);
std::optional<Matter> prismMatter(const LeafNumbers& k);

}  // namespace mb
