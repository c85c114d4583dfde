// The reader of recordings: line by line, collecting what is wrong. The scenes in it are the scene format's to read.
#include "core/scene/text_reader.h"
#include "physics/recording.h"

#include <algorithm>
#include <charconv>

namespace mb {
namespace {

using text::Line, text::Piece, text::shown;

constexpr std::string_view kFirst = "marchbox-recording";

/// The text as a whole number of that base, all of it and nothing else.
template <class Whole> std::optional<Whole> parseWhole(std::string_view text, int base = 10) {
    Whole value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc{} || rest != text.data() + text.size() || text.empty()) return std::nullopt;
    return value;
}

/// Calls `each(part, where it begins)` for every part of a list joined by commas, as long as it says yes.
template <class Each> void forEachPart(std::string_view list, Each each) {
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t comma = std::min(list.find(',', at), list.size());
        if (!each(list.substr(at, comma - at), at)) return;
        at = comma + 1;
    }
}

class Reader {
public:
    RecordingResult read(std::string_view bytes);

private:
    void readLine(std::string_view line);
    void record(const Line& line);
    bool version(const Line& line);
    void unknown(const Line& line);
    void step(const Line& line);
    void bodies(const Piece& piece, std::vector<std::uint32_t>& out);
    void action(const Line& line, const ActionKind& kind);
    void argument(const Piece& piece, const Argument& argument, Action& out);
    void beginScene(const Line& line);
    void endScene();
    void numberObjects(Scene& scene);
    /// Holds the pieces of a line to be one of each key, and no others.
    bool keysAre(const Line& line, std::span<const std::string_view> keys, std::size_t needed);
    void add(const Piece& piece, std::string expected) {
        faults_.add(piece.value.at, fmt::format("'{}' is {}, {}", piece.key, shown(piece.value.text), expected));
    }

    text::Faults faults_;
    RecordingResult result_;
    Line line_;
    bool begun_ = false, ended_ = false, has_scene_ = false;
    // The scene whose lines are being read.
    bool in_scene_ = false;
    std::string scene_text_;
    int scene_line_ = 0;                 // of its first line
    std::vector<std::uint32_t> ids_;     // none: 1, 2, 3 …
    text::Place ids_place_;
};

RecordingResult Reader::read(std::string_view bytes) {
    const int number = faults_.eachLine(bytes, [&](std::string_view line) { readLine(line); });
    if (in_scene_ && !faults_.stopped()) endScene();
    faults_.startLine(number + 1, {});
    if (!begun_ && faults_.none()) faults_.add(text::Place{}, "there is no record, expected 'marchbox-recording 1'");
    else if (!has_scene_ && faults_.none()) faults_.add(0, "the file ends without a 'scene'");
    else if (!ended_ && faults_.none()) faults_.add(0, "the file ends without 'end': it was cut short");
    result_.faults = faults_.take();
    if (!result_.faults.empty()) result_.recording = {};
    return std::move(result_);
}

void Reader::readLine(std::string_view line) {
    if (in_scene_ && (line.starts_with("  ") || line.empty())) {
        scene_text_.append(line.substr(std::min<std::size_t>(line.size(), 2))) += '\n';
        return;
    }
    if (in_scene_) endScene();
    if (const std::size_t bad = text::firstBadByte(line); bad < line.size()) {
        faults_.add(bad, fmt::format("a byte (0x{:02x}) that no text has, expected UTF-8", static_cast<unsigned char>(line[bad])));
        return faults_.stop();
    }
    text::cut(line, line_);
    for (text::LexFault& f : line_.faults) faults_.add(f.at, std::move(f.message));
    if (!line_.pieces.empty() && line_.faults.empty()) record(line_);
}

void Reader::record(const Line& line) {
    const std::string_view word = line.pieces.front().key.empty() ? std::string_view(line.pieces.front().value.text) : std::string_view();
    const auto kind = std::ranges::find(actionKinds(), word, &ActionKind::name);
    if (!begun_) {
        if (!version(line)) faults_.stop();
        begun_ = true;
    } else if (ended_) {
        faults_.add(line.indent, "a record behind 'end', expected none");
    } else if (word == "scene" && !has_scene_) {
        has_scene_ = true;
        beginScene(line);
    } else if (word == "step" || word == "end" || kind != actionKinds().end()) {
        if (!has_scene_) {
            faults_.add(line.indent, fmt::format("'{}' stands before the scene, expected it behind it", word));
            return faults_.stop();
        }
        if (word == "step") step(line);
        else if (word == "end") ended_ = keysAre(line, {}, 0);
        else action(line, *kind);
    } else unknown(line);
}

bool Reader::version(const Line& line) {
    const auto is = [&](std::size_t i, std::string_view word) { return line.pieces[i].key.empty() && line.pieces[i].value.text == word; };
    if (!is(0, kFirst)) return faults_.add(line.indent, "the first record is not 'marchbox-recording 1'"), false;
    if (line.pieces.size() == 2 && is(1, "1") && line.indent == 0) return true;
    faults_.add(line.pieces.back().at, "the version is not known, expected 'marchbox-recording 1'");
    return false;
}

void Reader::unknown(const Line& line) {
    std::vector<std::string_view> words{"step", "end"};
    for (const ActionKind& kind : actionKinds()) words.push_back(kind.name);
    const Piece& piece = line.pieces.front();
    if (!piece.key.empty()) faults_.add(piece.at, fmt::format("the record has no keyword, expected one of {}", fmt::join(words, ", ")));
    else if (piece.value.text == "scene") faults_.add(piece.at, "a second 'scene', expected one");
    else faults_.add(piece.at, fmt::format("unknown keyword {}{}", shown(piece.value.text), text::nearest(piece.value.text, words)));
}

bool Reader::keysAre(const Line& line, std::span<const std::string_view> keys, std::size_t needed) {
    const std::size_t before = faults_.count();
    if (line.indent > 0) faults_.add(line.indent, "the record is indented, expected it at the start of the line");
    std::uint64_t seen = 0;
    for (const Piece& piece : std::span(line.pieces).subspan(1)) {
        const auto at = static_cast<std::size_t>(std::ranges::find(keys, piece.key) - keys.begin());
        if (piece.key.empty() || at == keys.size())
            faults_.add(piece.at, fmt::format("{} is not known here{}", shown(piece.key.empty() ? piece.value.text : piece.key),
                                              text::nearest(piece.key, keys)));
        else if (seen >> at & 1) faults_.add(piece.at, fmt::format("'{}' stands twice in this record, expected once", piece.key));
        else if (piece.value.quoted) faults_.add(piece.value.at, fmt::format("'{}' is text in quotes, expected none", piece.key));
        else seen |= std::uint64_t{1} << at;
    }
    for (std::size_t i = 0; i < needed; ++i)
        if (!(seen >> i & 1) && faults_.count() == before) faults_.add(line.indent, fmt::format("no '{}', which the record must have", keys[i]));
    return faults_.count() == before;
}

void Reader::step(const Line& line) {
    static constexpr std::string_view kKeys[] = {"n", "state", "bodies"};
    if (!keysAre(line, kKeys, 2)) return;
    StepHash hash;
    const std::size_t n = result_.recording.steps.size() + 1;
    for (const Piece& piece : std::span(line.pieces).subspan(1)) {
        if (piece.key == "n" && parseWhole<std::size_t>(piece.value.text) != n) {
            add(piece, fmt::format("expected {}: the steps stand one after the other", n));
            faults_.stop();
        } else if (piece.key == "state") {
            const auto state = parseWhole<std::uint64_t>(piece.value.text, 16);
            if (!state || piece.value.text.size() != 16) add(piece, "expected 16 hexadecimal digits");
            hash.state = state.value_or(0);
        } else if (piece.key == "bodies") bodies(piece, hash.bodies);
    }
    result_.recording.steps.push_back(std::move(hash));
}

void Reader::bodies(const Piece& piece, std::vector<std::uint32_t>& out) {
    static const std::vector<std::uint32_t> none;
    const std::vector<std::uint32_t>& before = result_.recording.steps.empty() ? none : result_.recording.steps.back().bodies;
    forEachPart(piece.value.text, [&](std::string_view part, std::size_t at) {
        const bool same = part == "-" && out.size() < before.size();
        const auto hash = same ? before[out.size()] : parseWhole<std::uint32_t>(part, 16);
        if (hash && (same || part.size() == 8)) return out.push_back(*hash), true;
        faults_.add(piece.value.at + at,
                    fmt::format("a body's hash is {}, expected 8 hexadecimal digits, or '-' for that of the step before", shown(part)));
        return false;
    });
    out.shrink_to_fit();
}

void Reader::action(const Line& line, const ActionKind& kind) {
    Action action;
    action.kind = &kind, action.step = result_.recording.steps.size();
    if (kind.has_scene) {
        beginScene(line);
    } else {
        std::vector<std::string_view> keys;
        for (const Argument& a : kind.arguments) keys.push_back(a.name);
        if (!keysAre(line, keys, keys.size())) return;
        for (const Piece& piece : std::span(line.pieces).subspan(1))
            argument(piece, *std::ranges::find(kind.arguments, piece.key, &Argument::name), action);
    }
    result_.recording.actions.push_back(std::move(action));
}

void Reader::argument(const Piece& piece, const Argument& argument, Action& out) {
    struct Assign {
        Reader& reader;
        const Piece& piece;
        const Argument& argument;
        Action& out;
        void operator()(ObjectId Action::*m) const {
            const auto id = parseWhole<std::uint32_t>(piece.value.text);
            if (!id || *id == 0) return reader.add(piece, "expected the number of an object, from 1");
            const Scene* start = reader.result_.recording.start.get();
            if (start && std::ranges::find(start->objects, ObjectId{*id}, &Object::id) == start->objects.end())
                return reader.add(piece, "but the scene has no object of that number");
            (out.*m).value = *id;
        }
        void operator()(std::uint64_t Action::*m) const {
            const auto whole = parseWhole<std::uint64_t>(piece.value.text);
            if (!whole) return reader.add(piece, "expected a whole number from 0 to 18446744073709551615");
            out.*m = *whole;
        }
        void operator()(double Action::*m) const { real({&(out.*m), 1}); }
        void operator()(glm::dvec3 Action::*m) const { real({&(out.*m).x, 3}); }
        void real(std::span<double> numbers) const {
            if (const text::ValueFault f = text::readNumbers(piece.key, piece.value, {argument.lo, argument.hi, false}, numbers))
                reader.faults_.add(piece.value.at + f->at, f->message);
        }
    };
    std::visit(Assign{*this, piece, argument, out}, argument.member);
}

void Reader::beginScene(const Line& line) {
    static constexpr std::string_view kKeys[] = {"ids"};
    in_scene_ = true, scene_text_.clear(), ids_.clear(), scene_line_ = faults_.line() + 1;
    if (!keysAre(line, kKeys, 0) || line.pieces.size() < 2) return;
    const Piece& piece = line.pieces[1];
    ids_place_ = faults_.place(piece.value.at);
    forEachPart(piece.value.text, [&](std::string_view part, std::size_t at) {
        const auto id = parseWhole<std::uint32_t>(part);
        if (id && *id > 0) return ids_.push_back(*id), true;
        faults_.add(piece.value.at + at, fmt::format("an id is {}, expected a whole number from 1", shown(part)));
        return false;
    });
}

void Reader::endScene() {
    in_scene_ = false;
    ReadResult read = readScene(scene_text_);
    for (const Fault& f : read.faults) faults_.add({scene_line_ + f.line - 1, f.column + 2}, f.message);
    for (const Fault& f : read.warnings)
        if (result_.warnings.size() < kMaxFaults) result_.warnings.push_back({scene_line_ + f.line - 1, f.column + 2, f.message});
    if (!read.ok()) return;
    numberObjects(read.scene);
    auto scene = std::make_shared<const Scene>(std::move(read.scene));
    (result_.recording.start ? result_.recording.actions.back().scene : result_.recording.start) = std::move(scene);
}

/// Gives the objects the ids they had.
void Reader::numberObjects(Scene& scene) {
    if (ids_.empty()) return;
    if (ids_.size() != scene.objects.size())
        return faults_.add(ids_place_, fmt::format("'ids' has {} numbers, expected one for each of the {} objects", ids_.size(),
                                                   scene.objects.size()));
    for (std::size_t i = 0; i < ids_.size(); ++i) scene.objects[i].id.value = ids_[i];
    std::ranges::sort(ids_);
    if (std::ranges::adjacent_find(ids_) != ids_.end()) faults_.add(ids_place_, "'ids' has a number twice, expected each once");
    scene.last_id = std::max(scene.last_id, ids_.back());
}

}  // namespace

RecordingResult readRecording(std::string_view bytes) { return Reader().read(bytes); }

}  // namespace mb
