#include "core/scene/text_lex.h"

#include <fmt/format.h>

#include <algorithm>

namespace mb::text {

std::string shown(std::string_view text) {
    std::string out = "'";
    std::size_t characters = 0;
    for (const char c : text) {
        const bool begins = (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        if (begins && ++characters > 40) {
            out += "…";
            break;
        }
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return out + "'";
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(last), last.swap(row);
    }
    return last[b.size()];
}

std::string nearest(std::string_view unknown, std::span<const std::string_view> names) {
    constexpr std::size_t kCompared = 64;  // the rest of a longer name changes nothing; the work stays bounded
    const std::string_view* best = nullptr;
    std::size_t best_distance = 0;
    for (const std::string_view& name : names) {
        const std::size_t d = editDistance(unknown.substr(0, kCompared), name.substr(0, kCompared));
        if (!best || d < best_distance) best = &name, best_distance = d;
    }
    return best ? fmt::format(", the nearest is {}", shown(*best)) : "";
}

}  // namespace mb::text
