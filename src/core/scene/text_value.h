#pragma once
// Values of keys, from and to text: one function each for every kind of member a row of keys.h or shape.h may have.
#include "core/scene/keys.h"
#include "core/scene/text_lex.h"

#include <fmt/format.h>

#include <optional>

namespace mb::text {

/// What is wrong with a value, if anything: `at` counts from the value's first byte.
using ValueFault = std::optional<LexFault>;

struct Range {
    double lo = 0, hi = 0;
    bool whole = false;
};

/// Reads exactly out.size() numbers joined by commas.
ValueFault readNumbers(std::string_view key, const Value& value, Range range, std::span<double> out);
/// Reads one of the words, as its place among them.
ValueFault readWord(std::string_view key, const Value& value, std::span<const std::string_view> words, std::size_t& out);
/// Reads a name: a word, or text in quotes.
ValueFault readText(std::string_view key, const Value& value, std::string& out);
/// Reads one of an object's own keys into its numbers, of which `out` is the first.
ValueFault readParameter(const Parameter& parameter, const Value& value, double* out);

/// A name as a value: as it is if it is a word, else in quotes.
std::string nameText(std::string_view text);

template <class Record> ValueFault assign(Record& record, const Key<Record>& key, const Value& value) {
    return std::visit([&](auto member) -> ValueFault {
        auto& field = valueAt(record, member);
        using T = std::remove_cvref_t<decltype(field)>;
        if constexpr (std::is_same_v<T, std::string>) return readText(key.name, value, field);
        else if constexpr (std::is_same_v<T, Pattern>) {
            std::size_t index = 0;
            if (ValueFault f = readWord(key.name, value, patternWords(), index)) return f;
            field = static_cast<Pattern>(index);
            return {};
        } else if constexpr (std::is_same_v<T, glm::dvec3>) {
            glm::dvec3 read{0};
            if (ValueFault f = readNumbers(key.name, value, {key.lo, key.hi}, std::span(&read.x, 3))) return f;
            if (key.direction && read == glm::dvec3{0}) return LexFault{0, fmt::format("'{}' has no length, expected a direction", key.name)};
            field = read;
            return {};
        } else {
            constexpr bool truth = std::is_same_v<T, bool>, whole = truth || std::is_same_v<T, int>;
            double x = 0;
            Range range = truth ? Range{0, 1, true} : Range{key.lo, key.hi, whole};
            if constexpr (std::is_same_v<decltype(member), Slot>) range.whole = member.whole;
            if (ValueFault f = readNumbers(key.name, value, range, std::span(&x, 1))) return f;
            if constexpr (whole) field = static_cast<T>(x);
            else field = x;
            return {};
        }
    }, key.member);
}

/// A member's value as a file spells it.
std::string valueText(double x);
std::string valueText(int x);
std::string valueText(bool x);
std::string valueText(const glm::dvec3& v);
std::string valueText(const std::string& s);
std::string valueText(const std::optional<double>& x);
std::string valueText(Pattern p);

bool sameBits(double a, double b);
bool sameBits(const glm::dvec3& a, const glm::dvec3& b);
bool sameBits(const std::optional<double>& a, const std::optional<double>& b);
template <class T> bool sameBits(const T& a, const T& b) { return a == b; }

}  // namespace mb::text
