#pragma once
// A line of a scene's text, cut into its pieces, and the words and numbers these consist of. std::regex recurses once a
// character, so no pattern is given more than kWindow of them, and none can match one text in two ways.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mb::text {

inline constexpr std::size_t kWindow = 128;

struct Value {
    std::size_t at = 0;   // where it begins in its line, in bytes
    std::string text;     // without its quotes
    bool quoted = false;
};

/// `key:value`, or a text without a colon, whose key is empty.
struct Piece {
    std::size_t at = 0;
    std::string_view key;  // lives as long as the line
    Value value;
};

struct LexFault {
    std::size_t at = 0;
    std::string message;
};

struct Line {
    std::size_t indent = 0;      // leading spaces
    std::vector<Piece> pieces;   // none: the line is blank or a comment
    std::vector<LexFault> faults;
};

/// Cuts a line; whatever cannot be a piece is a fault, and the others still come out.
void cut(std::string_view line, Line& out);

/// The first byte that no text may hold: a control character other than a tab, or one that is not UTF-8. The line's size
/// if there is none.
std::size_t firstBadByte(std::string_view line);

bool isWord(std::string_view text);

/// A finite number and nothing else; nothing where the text is not one. `overflow` tells that it is one no double holds.
std::optional<double> parseNumber(std::string_view text, bool& overflow);
/// The shortest form that reads back to the same bits.
std::string number(double value);

/// Text from a file made fit for a message: at most 40 characters, in quotes.
std::string shown(std::string_view text);
/// `, the nearest is 'NAME'`, or nothing if there are no names.
std::string nearest(std::string_view unknown, std::span<const std::string_view> names);
/// The least number of letters to insert, drop, replace or swap with the next.
std::size_t editDistance(std::string_view a, std::string_view b);

}  // namespace mb::text
