#include "core/render/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>

namespace mb {
namespace {

using Names = std::set<std::string, std::less<>>;

struct Line {
    std::string_view text;
    long number;  // as a #line states it
};

std::string_view nextLine(std::string_view& rest) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return line;
}
bool isWordChar(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
std::string_view wordAt(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && isWordChar(text[end])) ++end;
    return text.substr(at, end - at);
}
/// What stands behind a directive: "FOG 3" of "#define FOG 3".
std::optional<std::string_view> behind(std::string_view line, std::string_view directive) {
    if (!line.starts_with(directive)) return std::nullopt;
    line.remove_prefix(directive.size());
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}
std::string_view code(std::string_view line) { return line.substr(0, std::min(line.find("//"), line.size())); }

/// The lines behind switches that are set, numbered. Conditions of the driver's own names stay as they are.
std::vector<Line> chosen(std::string_view text) {
    struct Condition {
        bool drivers, taken;
    };
    std::vector<Line> lines;
    std::vector<Condition> open;
    Names defined;
    for (long number = 1; !text.empty();) {
        const std::string_view line = nextLine(text);
        if (const auto stated = behind(line, "#line ")) {
            number = std::strtol(std::string(*stated).c_str(), nullptr, 10);
            continue;
        }
        const long own = number++;
        const auto name = behind(line, "#ifdef "), no_name = behind(line, "#ifndef ");
        const bool drivers = !open.empty() && open.back().drivers;
        const bool active = std::ranges::all_of(open, &Condition::taken);
        if (name || no_name) {
            const std::string_view word = wordAt(name ? *name : *no_name, 0);
            const bool of_driver = word.starts_with("GL_");
            open.push_back({of_driver, of_driver || defined.contains(word) == name.has_value()});
            if (!of_driver || !active) continue;
        } else if (line.starts_with("#if")) {
            open.push_back({true, true});  // a condition that only the driver can tell
        } else if (behind(line, "#else") && !open.empty() && !drivers) {
            open.back().taken = !open.back().taken;
            continue;
        } else if (behind(line, "#endif") && !open.empty()) {
            open.pop_back();
            if (!drivers) continue;
        }
        if (!active) continue;
        if (const auto definition = behind(line, "#define ")) defined.emplace(wordAt(*definition, 0));
        lines.push_back({line, own});
    }
    return lines;
}

/// A declaration with the comment above it, or a directive, or what stands between.
struct Item {
    std::size_t first, last;  // lines [first, last)
    std::string_view name;    // empty: it stays whatever else does
    bool kept = false;
};

/// The name that a declaration of the file's level gives; nothing where it has several or none, so that it stays.
std::string_view declaredName(std::string_view head) {
    if (const auto definition = behind(head, "#define ")) return wordAt(*definition, 0);
    if (head.starts_with('#') || head.starts_with("layout") || head.starts_with("uniform") || head.starts_with("precision")) return {};
    const std::size_t end = head.starts_with("struct ") ? head.find('{') : head.find_first_of("(=;[{,");
    if (end == head.npos || end == 0 || head[end] == '[' || head[end] == ',') return {};
    if (head[end] == '=' && head.find(',') != head.npos && head.find('(') == head.npos) return {};
    std::size_t last = head.find_last_not_of(' ', end - 1);
    if (last == head.npos) return {};
    std::size_t first = last;
    while (first > 0 && isWordChar(head[first - 1])) --first;
    return head.substr(first, last + 1 - first);
}

std::vector<Item> itemsOf(const std::vector<Line>& lines) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < lines.size();) {
        Item item{i, i, {}};
        while (i < lines.size() && lines[i].text.starts_with("//")) ++i;  // the comment above it
        if (i == lines.size() || lines[i].text.empty()) {
            item.last = std::min(i + 1, lines.size()), item.name = "//";  // a remark of its own, or an empty line: nothing needs it
        } else {
            item.name = declaredName(lines[i].text);
            int depth = 0;
            for (bool more = true; more && i < lines.size(); ++i) {
                const std::string_view text = code(lines[i].text);
                depth += static_cast<int>(std::ranges::count(text, '{') - std::ranges::count(text, '}'));
                const std::size_t last = text.find_last_not_of(' ');
                more = !text.starts_with('#') && (depth > 0 || last == text.npos || (text[last] != '}' && text[last] != ';'));
            }
            item.last = i;
            if (lines[item.last - 1].text.starts_with('}') && code(lines[item.last - 1].text).size() > 2) item.name = {};  // a structure and a variable of it
        }
        i = item.last;
        items.push_back(item);
    }
    return items;
}

/// Every word of the item's code.
void addWords(const std::vector<Line>& lines, const Item& item, std::vector<std::string_view>& out) {
    for (std::size_t i = item.first; i < item.last; ++i) {
        const std::string_view text = code(lines[i].text);
        for (std::size_t at = 0; at < text.size();) {
            if (!isWordChar(text[at])) {
                ++at;
                continue;
            }
            const std::string_view word = wordAt(text, at);
            out.push_back(word);
            at += word.size();
        }
    }
}

void keepReachable(const std::vector<Line>& lines, std::vector<Item>& items) {
    std::vector<std::string_view> words{"main"};
    Names known;
    for (Item& item : items)
        if (item.name.empty()) item.kept = true, addWords(lines, item, words);
    while (!words.empty()) {
        const std::string_view word = words.back();
        words.pop_back();
        if (!known.emplace(word).second) continue;
        for (Item& item : items)
            if (!item.kept && item.name == word) item.kept = true, addWords(lines, item, words);
    }
}

}  // namespace

Composed stripped(const Composed& composed) {
    if (composed.text.find("/*") != std::string::npos || composed.text.find("\\\n") != std::string::npos) return composed;  // not this style
    const std::vector<Line> lines = chosen(composed.text);
    std::vector<Item> items = itemsOf(lines);
    keepReachable(lines, items);
    Composed out{{}, composed.files};
    long expected = 1;
    for (const Item& item : items) {
        if (!item.kept) continue;
        for (std::size_t i = item.first; i < item.last; ++i) {
            if (lines[i].number != expected) out.text += fmt::format("#line {}\n", lines[i].number);
            out.text.append(lines[i].text) += '\n';
            expected = lines[i].number + 1;
        }
    }
    return out;
}

}  // namespace mb
