#include "core/scene/text_reader.h"

#include <algorithm>

namespace mb {
namespace text {
namespace {

constexpr std::string_view kKeywords[] = {"world", "camera", "light", "material", "render", "physics", "object"};
constexpr int kVersion = 1;

std::string_view keyword(const Line& line) {
    return line.pieces.front().key.empty() ? std::string_view(line.pieces.front().value.text) : std::string_view();
}
bool isKeyword(std::string_view word) { return std::find(std::begin(kKeywords), std::end(kKeywords), word) != std::end(kKeywords); }

}  // namespace

Place Faults::place(std::size_t byte) const {
    int column = 1;
    for (const char c : line_.substr(0, byte)) column += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    return {number_, column};
}

void Faults::add(Place place, std::string message) {
    if (!stopped()) faults_.push_back({place.line, place.column, std::move(message)});
}

std::vector<Fault> Faults::take() {
    std::stable_sort(faults_.begin(), faults_.end(), [](const Fault& a, const Fault& b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    return std::move(faults_);
}

ReadResult Reader::read(std::string_view bytes) {
    if (wholeText(bytes)) {
        faults_.eachLine(bytes, [&](std::string_view line) { readLine(line); });
        if (form_ == Form::unknown && faults_.none()) faults_.add(Place{}, "there is no record, expected 'marchbox 1'");
        if (!faults_.stopped()) form_ == Form::older ? finishOlder() : finishObjects();
    }
    ReadResult result;
    result.render_line = std::max(render_line_, 1);
    result.faults = faults_.take();
    if (!result.ok()) return result;
    warn();
    result.scene = std::move(scene_);
    result.warnings = std::move(warnings_);
    return result;
}

/// What can be told of the bytes as a whole.
bool Reader::wholeText(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, 2);
    if (bytes.size() > Limits::file_bytes)
        faults_.add(Place{}, fmt::format("the file has {} bytes, expected at most {} (64 MiB)", bytes.size(), Limits::file_bytes));
    else if (head == "\xff\xfe" || head == "\xfe\xff" || (head.size() == 2 && (head[0] == 0) != (head[1] == 0)))
        faults_.add(Place{}, "the file is UTF-16, expected UTF-8");
    return faults_.none();
}

void Reader::readLine(std::string_view line) {
    if (line.size() > Limits::line_bytes) {
        faults_.add(Limits::line_bytes, fmt::format("the line has {} bytes, expected at most {}", line.size(), Limits::line_bytes));
        return unreadable(line);
    }
    if (const std::size_t bad = firstBadByte(line); bad < line.size()) {
        badByte(bad, static_cast<unsigned char>(line[bad]));
        return unreadable(line);
    }
    cut(line, line_);
    for (LexFault& f : line_.faults) faults_.add(f.at, std::move(f.message));
    if (line_.pieces.empty() && line_.faults.empty()) {
        if (const std::size_t hash = line.find('#'); at_head_ && hash < line.size()) scene_.comment.append(line.substr(hash)) += '\n';
        return;
    }
    at_head_ = false;
    // Of a line whose first piece is unsound nothing more can be told.
    if (line_.pieces.empty() || (!line_.faults.empty() && line_.faults.front().at < line_.pieces.front().at)) return unreadable(line);
    if (first(line_)) form_ == Form::older ? older(line_) : record(line_);
}

void Reader::badByte(std::size_t at, unsigned char byte) {
    if (byte == '\0') faults_.add(at, "a NUL byte, expected text"), faults_.stop();
    else if (byte == '\r') faults_.add(at, "a carriage return inside a line, expected lines that end in LF or CRLF");
    else if (byte < 0x80) faults_.add(at, fmt::format("a control character (0x{:02x}), expected text", byte));
    else faults_.add(at, fmt::format("a byte (0x{:02x}) that is not UTF-8, expected UTF-8", byte));
}

/// Keeps the place of a record that could not be read, so that nothing is said of its children or its parent.
void Reader::unreadable(std::string_view line) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size()), depth = indent / 2;
    if (line.substr(indent).starts_with('#')) return;
    if (depth < levels_.size()) levels_.resize(depth);
    if (!levels_.empty() && levels_.back().object >= 0) ++children_[static_cast<std::size_t>(levels_.back().object)];
    if (levels_.size() < Limits::levels) levels_.push_back({-1, true});
}

/// Whether the line is a record to be read: the first one tells which form the file has.
bool Reader::first(const Line& line) {
    if (form_ != Form::unknown) return true;
    const std::string_view key = line.pieces.front().key;
    if (key == "r" || key == "type") {
        form_ = Form::older;
        return true;
    }
    form_ = Form::version1;
    if (keyword(line) == "marchbox") {
        at_head_ = true;
        version(line);
        return false;
    }
    faults_.add(line.pieces.front().at, "the first record is not 'marchbox 1', expected it before all others");
    if (!isKeyword(keyword(line))) faults_.stop();
    return true;
}

void Reader::version(const Line& line) {
    const bool alone = line.pieces.size() == 2 && line.pieces[1].key.empty();
    bool overflow = false;
    const double number = alone ? parseNumber(line.pieces[1].value.text, overflow).value_or(0) : 0;
    if (line.indent > 0) faults_.add(line.indent, "'marchbox' is indented, expected it at the start of the line");
    if (number == kVersion) return;
    const std::size_t at = line.pieces.size() > 1 ? line.pieces[1].at : line.pieces[0].at;
    if (overflow || number > kVersion) {
        faults_.add(at, fmt::format("the file is of version {}, expected at most {}: a newer marchbox wrote it",
                                    line.pieces[1].value.text.substr(0, 20), kVersion));
        faults_.stop();
    } else faults_.add(at, "the version is not known, expected 'marchbox 1'");
}

void Reader::record(const Line& line) {
    const std::string_view word = keyword(line);
    bool bad_indent = false;
    const int depth = level(line, bad_indent);
    if (faults_.stopped()) return;
    const auto parent = depth > 0 ? std::optional(levels_[static_cast<std::size_t>(depth) - 1]) : std::nullopt;
    levels_.resize(static_cast<std::size_t>(depth));
    levels_.push_back({});
    if (depth > 0 && !bad_indent && isKeyword(word) && word != "object")
        faults_.add(line.indent, fmt::format("'{}' is indented, expected it at the start of the line: only objects are children", word));

    if (word == "world") only(line, scene_.world, world_line_);
    else if (word == "render") only(line, scene_.render, render_line_);
    else if (word == "physics") only(line, scene_.physics, physics_line_);
    else if (word == "camera") camera(line);
    else if (word == "light") {
        listed(line, scene_.lights, Limits::lights, "lights");
        if (!faults_.stopped()) nameOnce(line, "light", scene_.lights.back().name, light_names_);
    } else if (word == "material") {
        listed(line, scene_.materials, Limits::materials, "materials");
        if (!faults_.stopped()) nameOnce(line, "material", scene_.materials.back().name, material_names_);
    } else if (word == "object") object(line, parent, bad_indent);
    else {
        levels_.back().unknown = true;
        if (word == "marchbox") faults_.add(line.indent, "a second 'marchbox', expected one, at the start of the file");
        else if (word.empty()) faults_.add(line.indent, fmt::format("the record has no keyword, expected one of {}",
                                                                    fmt::join(kKeywords, ", ")));
        else faults_.add(line.indent, fmt::format("unknown keyword {}{}", shown(word), nearest(word, kKeywords)));
    }
}

/// How deep the record stands.
int Reader::level(const Line& line, bool& bad) {
    const std::size_t deepest = levels_.size();
    bad = true;
    if (line.pieces.front().at != line.indent)
        faults_.add(line.indent, "a tab in the indent, expected two spaces a level");
    else if (line.indent % 2 != 0)
        faults_.add(line.indent, fmt::format("an indent of {} spaces, expected two a level", line.indent));
    else if (line.indent / 2 >= Limits::levels) {
        faults_.add(line.indent, fmt::format("the record stands on level {}, expected at most {}", line.indent / 2 + 1, Limits::levels));
    } else if (line.indent / 2 > deepest)
        faults_.add(line.indent, fmt::format("an indent of {} spaces, expected at most {} here", line.indent, 2 * deepest));
    else bad = false;
    return static_cast<int>(std::min({line.indent / 2, deepest, Limits::levels - 1}));
}

template <class Record> void Reader::only(const Line& line, Record& record, int& first_line) {
    const std::string_view word = keyword(line);
    if (first_line > 0)
        faults_.add(line.indent, fmt::format("a second '{}' record, expected one: the first is on line {}", word, first_line));
    else first_line = faults_.line();
    record = {};
    readKeys(faults_, fmt::format("'{}'", word), line, 1, record, {}, [](const Piece&) { return false; });
}

template <class Record>
void Reader::listed(const Line& line, std::vector<Record>& records, std::size_t limit, std::string_view many) {
    if (!room(line.indent, records.size(), limit, many)) return;
    readKeys(faults_, fmt::format("'{}'", keyword(line)), line, 1, records.emplace_back(), {}, [](const Piece&) { return false; });
}

void Reader::camera(const Line& line) {
    const std::size_t before = faults_.count();
    listed(line, scene_.cameras, Limits::cameras, "cameras");
    if (faults_.stopped()) return;
    const Camera& c = scene_.cameras.back();
    nameOnce(line, "camera", c.name, camera_names_);
    const glm::dvec3 d = c.target - c.eye;
    if (faults_.count() == before && !(d.x * d.x + d.y * d.y + d.z * d.z > 1e-24))
        faults_.add(line.indent, "'eye' and 'target' are the same point, expected two");
}

bool Reader::room(std::size_t at, std::size_t count, std::size_t limit, std::string_view many) {
    if (count < limit) return true;
    faults_.add(at, fmt::format("more than {} {}, expected at most as many", limit, many));
    faults_.stop();
    return false;
}

void Reader::nameOnce(const Line& line, std::string_view kind, const std::string& name, std::map<std::string, int>& names) {
    const auto piece = std::find_if(line.pieces.begin(), line.pieces.end(), [](const Piece& p) { return p.key == "name"; });
    if (piece == line.pieces.end()) return;
    if (name.empty()) {
        if (kind == "material" && piece->value.quoted) faults_.add(piece->value.at, "the name of a material is empty, expected one");
        return;
    }
    const auto [known, added] = names.try_emplace(name, faults_.line());
    if (!added)
        faults_.add(piece->value.at, fmt::format("the {} of line {} is called {} too, expected a name of its own", kind,
                                                 known->second, shown(name)));
}

}  // namespace text

ReadResult readScene(std::string_view bytes) { return text::Reader().read(bytes); }

std::string describe(const Fault& fault, std::string_view file, std::string_view kind) {
    return fmt::format("{}:{}:{}: {}: {}", file, fault.line, fault.column, kind, fault.message);
}

}  // namespace mb
