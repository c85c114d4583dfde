#include "core/scene/text_value.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace mb::text {
namespace {

std::string expected(Range range) {
    return fmt::format("expected {} {} to {}", range.whole ? "a whole number from" : "a number from", number(range.lo),
                       number(range.hi));
}

ValueFault readNumber(std::string_view key, std::string_view text, std::size_t at, Range range, double& out) {
    bool overflow = false;
    const std::optional<double> x = parseNumber(text, overflow);
    if (overflow) return LexFault{at, fmt::format("'{}' is {}, which no double holds, {}", key, text, expected(range))};
    if (!x && text.size() > kWindow)
        return LexFault{at, fmt::format("'{}' has {} characters, expected a number of at most {}", key, text.size(), kWindow)};
    if (!x) return LexFault{at, fmt::format("'{}' is {}, {}", key, shown(text), expected(range))};
    if (*x < range.lo || *x > range.hi || (range.whole && *x != std::floor(*x)))
        return LexFault{at, fmt::format("'{}' is {}, {}", key, number(*x), expected(range))};
    out = *x;
    return {};
}

}  // namespace

ValueFault readNumbers(std::string_view key, const Value& value, Range range, std::span<double> out) {
    const std::string_view text = value.text;
    if (value.quoted) return LexFault{0, fmt::format("'{}' is text in quotes, {}", key, expected(range))};
    const std::size_t count = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
    if (count != out.size())
        return LexFault{0, fmt::format("'{}' has {} value{}, expected {}", key, count, count == 1 ? "" : "s",
                                       out.size() == 1 ? "1 number" : fmt::format("{} numbers joined by commas", out.size()))};
    std::vector<double> read(count);
    for (std::size_t i = 0, at = 0; i < count; ++i) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        if (ValueFault f = readNumber(key, text.substr(at, comma - at), at, range, read[i])) return f;
        at = comma + 1;
    }
    std::copy(read.begin(), read.end(), out.begin());
    return {};
}

ValueFault readWord(std::string_view key, const Value& value, std::span<const std::string_view> words, std::size_t& out) {
    const auto found = std::find(words.begin(), words.end(), value.text);
    if (value.quoted || found == words.end())
        return LexFault{0, fmt::format("'{}' is {}, expected {}{}", key, shown(value.text), fmt::join(words, ", "),
                                       nearest(value.text, words))};
    out = static_cast<std::size_t>(found - words.begin());
    return {};
}

ValueFault readText(std::string_view key, const Value& value, std::string& out) {
    if (!value.quoted && !isWord(value.text))
        return LexFault{0, fmt::format("'{}' is {}, expected a word, or text in quotes", key, shown(value.text))};
    out = value.text;
    return {};
}

ValueFault readParameter(const Parameter& p, const Value& value, double* out) {
    if (p.kind != Parameter::Kind::word)
        return readNumbers(p.name, value, {p.lo, p.hi, p.kind == Parameter::Kind::whole},
                           std::span(out, static_cast<std::size_t>(p.size)));
    std::size_t index = 0;
    if (ValueFault f = readWord(p.name, value, p.words, index)) return f;
    *out = static_cast<double>(index);
    return {};
}

std::string nameText(std::string_view text) {
    if (isWord(text)) return std::string(text);
    std::string out = "\"";
    while (!text.empty()) {
        const std::size_t good = firstBadByte(text);
        for (const char c : text.substr(0, good)) {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
        if (good == text.size()) break;
        out += static_cast<unsigned char>(text[good]) < 0x80 ? " " : "\ufffd";
        text.remove_prefix(good + 1);
    }
    return out + "\"";
}

std::string valueText(double x) { return number(x); }
std::string valueText(int x) { return fmt::format("{}", x); }
std::string valueText(bool x) { return x ? "1" : "0"; }
std::string valueText(const glm::dvec3& v) { return number(v.x) + "," + number(v.y) + "," + number(v.z); }
std::string valueText(const std::string& s) { return nameText(s); }
std::string valueText(const std::optional<double>& x) { return number(x.value_or(0)); }
std::string valueText(Pattern p) { return std::string(patternWords()[static_cast<std::size_t>(p)]); }

bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool sameBits(const glm::dvec3& a, const glm::dvec3& b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool sameBits(const std::optional<double>& a, const std::optional<double>& b) {
    return a.has_value() == b.has_value() && (!a || sameBits(*a, *b));
}

}  // namespace mb::text
