#pragma once
// A small checker of XML and of HTML as the reports write it: every tag closed in its place, every name, attribute and escape one.
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace mb {

struct Markup {
    std::string fault;                   // the first; empty: none
    std::map<std::string, int> elements; // how many of each name
    std::vector<std::string> texts;      // between tags, as it is read: escapes undone
    std::vector<std::pair<std::string, std::string>> attributes;

    /// The values of the attributes of that name.
    std::vector<std::string> valuesOf(const std::string& name) const {
        std::vector<std::string> found;
        for (const auto& [key, value] : attributes)
            if (key == name) found.push_back(value);
        return found;
    }
    bool says(const std::string& text) const {
        for (const std::string& t : texts)
            if (t.find(text) != std::string::npos) return true;
        return false;
    }
};

class MarkupReader {
public:
    MarkupReader(const std::string& text, bool html) : text_(text), html_(html) {}
    Markup read() {
        std::vector<std::string> open;
        while (at_ < text_.size() && out_.fault.empty()) {
            if (text_[at_] == '<') tag(open);
            else words(open);
        }
        if (out_.fault.empty() && !open.empty()) fail("not closed: " + open.back());
        return out_;
    }

private:
    void fail(const std::string& why) {
        if (out_.fault.empty()) out_.fault = why + " at " + std::to_string(at_) + ": " + text_.substr(at_ > 20 ? at_ - 20 : 0, 60);
    }
    /// Up to a character, with its escapes undone.
    std::string until(char end) {
        static const std::map<std::string, char> kEscapes{{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}};
        std::string found;
        for (; at_ < text_.size() && text_[at_] != end; ++at_) {
            const char c = text_[at_];
            if (c == '<' || (c == '>' && end == '<')) return fail("a bare bracket"), found;
            if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') return fail("a control character"), found;
            if (c != '&') {
                found += c;
                continue;
            }
            const std::size_t stop = text_.find(';', at_);
            const auto escape = stop == std::string::npos ? kEscapes.end() : kEscapes.find(text_.substr(at_ + 1, stop - at_ - 1));
            if (escape == kEscapes.end()) return fail("a bare ampersand"), found;
            found += escape->second, at_ = stop;
        }
        return found;
    }
    void words(const std::vector<std::string>& open) {
        if (!open.empty() && open.back() == "style") {
            at_ = text_.find('<', at_);
            return;
        }
        const std::string found = until('<');
        if (open.empty() && found.find_first_not_of(" \n\t") != std::string::npos) fail("text outside of everything");
        if (!found.empty()) out_.texts.push_back(found);
    }
    std::string name() {
        std::string found;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '-' || text_[at_] == ':')) found += text_[at_++];
        if (found.empty()) fail("no name");
        return found;
    }
    void tag(std::vector<std::string>& io_open) {
        ++at_;
        if (html_ && text_.compare(at_, 9, "!doctype ") == 0) {
            at_ = text_.find('>', at_) + 1;
            return;
        }
        const bool closes = text_[at_] == '/';
        if (closes) ++at_;
        const std::string what = name();
        if (closes) {
            if (io_open.empty() || io_open.back() != what) return fail("closes what is not open: " + what);
            io_open.pop_back();
            if (text_[at_++] != '>') fail("not the end of a tag");
            return;
        }
        ++out_.elements[what];
        std::set<std::string> seen;
        while (at_ < text_.size() && out_.fault.empty()) {
            while (text_[at_] == ' ' || text_[at_] == '\n') ++at_;
            if (text_[at_] == '>') {
                ++at_;
                static const std::set<std::string> kEmpty{"meta", "img", "br"};
                if (!html_ || !kEmpty.contains(what)) io_open.push_back(what);
                return;
            }
            if (text_.compare(at_, 2, "/>") == 0) {
                at_ += 2;
                return;
            }
            const std::string key = name();
            if (!seen.insert(key).second) fail("twice: " + key);
            if (text_.compare(at_, 2, "=\"") != 0) return fail("an attribute without a value");
            at_ += 2;
            const std::string value = until('"');
            ++at_;
            out_.attributes.emplace_back(key, value);
        }
        fail("a tag without an end");
    }

    const std::string& text_;
    bool html_;
    std::size_t at_ = 0;
    Markup out_;
};

inline Markup readXml(const std::string& text) { return MarkupReader(text, false).read(); }
inline Markup readHtml(const std::string& text) { return MarkupReader(text, true).read(); }

}  // namespace mb
