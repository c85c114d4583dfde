// How a row is declared: in the library's text, and in its own names and ranges.
#include "sdf/primitive_laws.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb {

std::string signatureViolation(const Primitive& row, std::string_view glsl) {
    std::string want = fmt::format("real {}(vec3 p", row.glsl);
    for (const Parameter& p : row.parameters) want += fmt::format(", {} {}", p.size == 3 ? "vec3" : "real", p.name);
    if (!row.derived.empty()) want += fmt::format(", real {}", row.derived);
    want += ") {";
    return glsl.find(want) == glsl.npos ? "the library has no " + want : std::string();
}

std::string nameViolation(const ShapeType& type) {
    if (type.name.empty() || type.tip.empty()) return "no name or tip";
    if (findShapeType(type.name) != &type) return fmt::format("{}: the name finds another row", type.name);
    return {};
}

std::string rangeViolation(std::span<const Parameter> parameters) {
    int numbers = 0;
    for (const Parameter& p : parameters) {
        const auto fault = [&](std::string_view what) { return fmt::format("{}: {}", p.name, what); };
        if (p.name.empty() || (p.size != 1 && p.size != 3)) return fault("no name, or neither 1 nor 3 numbers");
        if ((numbers += p.size) > kMaxParameters) return fault("too many numbers");
        if (std::ranges::count(parameters, p.name, &Parameter::name) != 1) return fault("twice");
        if (!(p.lo < p.hi)) return fault("an empty range");
        const bool word = p.kind == Parameter::Kind::word, whole = word || p.kind == Parameter::Kind::whole;
        if (word ? static_cast<double>(p.words.size()) != p.hi + 1
                 : !(p.lo <= p.slider_lo && p.slider_lo < p.slider_hi && p.slider_hi <= p.hi))
            return fault("the slider leaves the range");
        if (whole && (p.lo != std::round(p.lo) || p.hi != std::round(p.hi))) return fault("a whole number's range is not whole");
        for (int i = 0; i < p.size; ++i) {
            const double x = p.initial[static_cast<std::size_t>(i)];
            if (!(p.lo <= x && x <= p.hi)) return fault("the initial value is out of range");
            if (whole && x != std::round(x)) return fault("the initial value is not whole");
        }
    }
    return {};
}

}  // namespace mb
