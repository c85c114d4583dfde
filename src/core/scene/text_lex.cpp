#include "core/scene/text_lex.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>

namespace mb::text {
namespace {

/// A pattern that means the same under every locale.
std::regex pattern(const char* text) {
    std::regex r;
    r.imbue(std::locale::classic());
    r.assign(text, std::regex::ECMAScript | std::regex::optimize);
    return r;
}

/// How many bytes at the front of `text` the pattern matches, of at most kWindow.
std::size_t front(const std::regex& r, std::string_view text) {
    std::cmatch match;
    const char* const end = text.data() + std::min(text.size(), kWindow);
    if (!std::regex_search(text.data(), end, match, r, std::regex_constants::match_continuous)) return 0;
    return static_cast<std::size_t>(match.length());
}

bool isBlank(char c) { return c == ' ' || c == '\t'; }
/// What may stand behind a piece.
bool endsPiece(std::string_view line, std::size_t at) { return at >= line.size() || isBlank(line[at]) || line[at] == '#'; }

/// Reads text in quotes from its opening one at `at`; gives where it ends.
std::size_t cutQuoted(std::string_view line, std::size_t at, Value& value, Line& out) {
    static const std::regex plain = pattern("[^\"\\\\]+"), escape = pattern("\\\\[\"\\\\]");
    value.quoted = true;
    std::size_t p = at + 1;
    while (p < line.size() && line[p] != '"') {
        if (const std::size_t n = front(plain, line.substr(p))) {
            value.text.append(line.substr(p, n)), p += n;
        } else if (front(escape, line.substr(p))) {
            value.text += line[p + 1], p += 2;
        } else {
            out.faults.push_back({p, "a backslash in quotes, expected \\\" or \\\\"});
            p = std::min(p + 2, line.size());
        }
    }
    if (p >= line.size()) {
        out.faults.push_back({at, "the quotes are not closed, expected \" before the end of the line"});
        return line.size();
    }
    return p + 1;
}

/// Reads the piece at `at`, gives where it ends.
std::size_t cutPiece(std::string_view line, std::size_t at, Line& out) {
    static const std::regex head = pattern("[A-Za-z][A-Za-z0-9_]*:");
    const std::size_t known_faults = out.faults.size();
    Piece piece{at, {}, {}};
    if (const std::size_t n = front(head, line.substr(at))) piece.key = line.substr(at, n - 1), piece.value.at = at + n;
    else piece.value.at = at;

    std::size_t end = piece.value.at;
    if (end < line.size() && line[end] == '"') end = cutQuoted(line, end, piece.value, out);
    else {
        while (!endsPiece(line, end) && line[end] != '"') ++end;
        piece.value.text = line.substr(piece.value.at, end - piece.value.at);
    }
    if (!endsPiece(line, end)) {
        out.faults.push_back({end, fmt::format("{} inside a value, expected quotes around the whole of it",
                                               line[end] == '"' ? "a quote" : "text behind a closing quote")});
        while (!endsPiece(line, end)) ++end;
    } else if (end == piece.value.at) {
        out.faults.push_back({end, fmt::format("no value behind '{}:'", piece.key)});
    } else if (piece.key.empty() && piece.value.quoted) {
        out.faults.push_back({at, "text in quotes without a key, expected key:\"text\""});
    }
    if (out.faults.size() == known_faults) out.pieces.push_back(std::move(piece));
    return end;
}

}  // namespace

void cut(std::string_view line, Line& out) {
    out.pieces.clear(), out.faults.clear();
    out.indent = std::min(line.find_first_not_of(' '), line.size());
    for (std::size_t at = out.indent; at < line.size() && line[at] != '#';) {
        if (isBlank(line[at])) ++at;
        else at = cutPiece(line, at, out);
    }
}

std::size_t firstBadByte(std::string_view s) {
    const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
    for (std::size_t i = 0; i < s.size();) {
        const unsigned c = byte(i);
        if (c < 0x80) {
            if ((c < 0x20 && c != '\t') || c == 0x7f) return i;
            ++i;
            continue;
        }
        const std::size_t n = c >= 0xc2 && c <= 0xdf ? 2 : c >= 0xe0 && c <= 0xef ? 3 : c >= 0xf0 && c <= 0xf4 ? 4 : 0;
        if (n == 0) return i;
        // The second byte's range leaves out what has a shorter form, the surrogates, and what is beyond U+10FFFF.
        const unsigned lo = c == 0xe0 ? 0xa0 : c == 0xf0 ? 0x90 : 0x80, hi = c == 0xed ? 0x9f : c == 0xf4 ? 0x8f : 0xbf;
        if (byte(i + 1) < lo || byte(i + 1) > hi) return i;
        for (std::size_t k = 2; k < n; ++k)
            if (byte(i + k) < 0x80 || byte(i + k) > 0xbf) return i;
        i += n;
    }
    return s.size();
}

bool isWord(std::string_view text) {
    static const std::regex word = pattern("[A-Za-z_][A-Za-z0-9_.-]*");
    return !text.empty() && front(word, text) == text.size();
}

std::optional<double> parseNumber(std::string_view text, bool& overflow) {
    static const std::regex form = pattern("-?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?");
    overflow = false;
    if (text.empty() || text.size() > kWindow || front(form, text) != text.size()) return std::nullopt;
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    overflow = error == std::errc::result_out_of_range;  // `value` is then not what the text says
    if (error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string number(double value) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    std::string out(buffer, end);
    // 1e+06 and 1e-06 are 1e6 and 1e-6.
    if (const std::size_t e = out.find('e'); e != std::string::npos) {
        if (out[e + 1] == '+') out.erase(e + 1, 1);
        const std::size_t digits = out[e + 1] == '-' ? e + 2 : e + 1;
        if (out[digits] == '0' && digits + 1 < out.size()) out.erase(digits, 1);
    }
    return out;
}

}  // namespace mb::text
