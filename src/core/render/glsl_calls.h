#pragma once
// How generated GLSL calls the functions of shaders/sdf/.
#include "core/sdf/shape.h"

#include <fmt/format.h>

#include <string>

namespace mb {

/// ", box3.numbers.x, …": a type's numbers as the library's functions take them, from the record of that name; `all` of them,
/// derived ones included.
inline std::string numbersOf(std::string_view record, std::span<const Parameter> parameters, int all) {
    static constexpr std::string_view kNumbers[] = {"numbers.x", "numbers.y", "numbers.z", "numbers.w"};
    std::string text;
    const auto number = [&](int at) { return fmt::format("{}.{}", record, kNumbers[at]); };
    int at = 0;
    for (const Parameter& p : parameters) {
        if (p.size == 3) text += fmt::format(", vec3({}, {}, {})", number(at), number(at + 1), number(at + 2));
        else text += ", " + number(at);
        at += p.size;
    }
    for (; at < all; ++at) text += ", " + number(at);
    return text;
}

/// An Ahead (lib/ahead.glsl) of a leaf, along the ray whose origin and direction begin these arguments.
inline std::string aheadCall(const Primitive& p, std::string_view arguments) {
    if (p.span.empty()) return "UNKNOWN_AHEAD";
    return fmt::format("onlyAhead({}({}), {})", p.span, arguments, p.inner.empty() ? "vec2(EMPTY, -EMPTY)" : fmt::format("{}({})", p.inner, arguments));
}
/// An Ahead of two under an operator without a blend.
inline std::string aheadFold(const Operator& o, std::string_view a, std::string_view b) {
    const std::string arguments = fmt::format("{0}.span, {0}.inner, {1}.span, {1}.inner", a, b);
    return fmt::format("Ahead({0}({2}), {1}({2}))", o.span, o.inner, arguments);
}

}  // namespace mb
