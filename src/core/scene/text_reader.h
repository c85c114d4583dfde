#pragma once
// The reader of scene texts: line by line, through the tables of keys, collecting what is wrong.
#include "core/scene/text.h"
#include "core/scene/text_value.h"

#include <algorithm>
#include <map>

namespace mb::text {

struct Place {
    int line = 1, column = 1;
};

/// Collects faults, of the line being read or of an earlier place, until there are kMaxFaults.
class Faults {
public:
    void startLine(int number, std::string_view line) { number_ = number, line_ = line; }
    Place place(std::size_t byte) const;
    int line() const { return number_; }
    void add(std::size_t byte, std::string message) { add(place(byte), std::move(message)); }
    void add(Place place, std::string message);
    /// No more are wanted, or none can make sense: reading ends.
    bool stopped() const { return stopped_ || faults_.size() >= kMaxFaults; }
    void stop() { stopped_ = true; }
    bool none() const { return faults_.empty(); }
    std::size_t count() const { return faults_.size(); }
    std::vector<Fault> take();
    /// The lines of a file, without their ends and a byte order mark, until no more are wanted; the last one's number.
    template <class Read> int eachLine(std::string_view bytes, Read read) {
        if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
        int number = 0;
        for (std::size_t at = 0; at < bytes.size() && !stopped();) {
            const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
            std::string_view line = bytes.substr(at, end - at);
            if (line.ends_with('\r')) line.remove_suffix(1);
            startLine(++number, line);
            read(line);
            at = end + 1;
        }
        return number;
    }

private:
    int number_ = 1;
    std::string_view line_;
    std::vector<Fault> faults_;
    bool stopped_ = false;
};

/// Reads a record's pieces, from the one of index `begin`, into its keys' members. `other(piece)` takes a key that is not
/// among the record's rows and tells whether it knew it; `names` are those it knows. Gives a bit for each row that stood.
template <class Record, class Other>
std::uint64_t readKeys(Faults& faults, std::string_view what, const Line& line, std::size_t begin, Record& record,
                       std::span<const std::string_view> names, Other other) {
    const std::span<const Key<Record>> rows = keys<Record>();
    std::uint64_t seen = 0;
    for (const Piece& piece : std::span(line.pieces).subspan(begin)) {
        if (faults.stopped()) return seen;
        if (piece.key.empty()) {
            faults.add(piece.at, fmt::format("{} is no key, expected key:value", shown(piece.value.text)));
            continue;
        }
        std::size_t i = 0;
        while (i < rows.size() && rows[i].name != piece.key) ++i;
        if (i == rows.size()) {
            if (other(piece)) continue;
            std::vector<std::string_view> known(names.begin(), names.end());
            for (const Key<Record>& row : rows) known.push_back(row.name);
            faults.add(piece.at, fmt::format("unknown key {} of {}{}", shown(piece.key), what, nearest(piece.key, known)));
        } else if (seen >> i & 1) {
            faults.add(piece.at, fmt::format("'{}' stands twice in this record, expected once", piece.key));
        } else {
            seen |= std::uint64_t{1} << i;
            if (const ValueFault f = assign(record, rows[i], piece.value)) faults.add(piece.value.at + f->at, f->message);
        }
    }
    for (std::size_t i = 0; i < rows.size() && line.faults.empty(); ++i)
        if (rows[i].required && !(seen >> i & 1))
            faults.add(line.indent, fmt::format("no '{}', which {} must have", rows[i].name, what));
    return seen;
}

class Reader {
public:
    ReadResult read(std::string_view bytes);

private:
    enum class Form { unknown, version1, older };
    /// What a deeper record would be a child of.
    struct Level {
        int object = -1;       // its index, if it is an object
        bool unknown = false;  // it could not be read: nothing is said of its children
    };

    bool wholeText(std::string_view bytes);
    void readLine(std::string_view line);
    void badByte(std::size_t at, unsigned char byte);
    void unreadable(std::string_view line);
    bool first(const Line& line);
    void version(const Line& line);
    void record(const Line& line);
    int level(const Line& line, bool& bad);
    template <class Record> void only(const Line& line, Record& record, int& first_line);
    template <class Record> void listed(const Line& line, std::vector<Record>& records, std::size_t limit, std::string_view many);
    void camera(const Line& line);
    void older(const Line& line);
    void finishOlder();
    void addOlderDefaults();

    void object(const Line& line, std::optional<Level> parent, bool bad_indent);
    const ShapeType* typeOf(const Line& line);
    void readObject(const Line& line, Object& object, bool child);
    bool typeKey(const Piece& piece, Object& object, std::uint32_t& seen);
    void parentTakes(const Line& line, Level parent);
    void finishObjects();
    void warn();

    /// Whether there is room for one more; if not, reading ends.
    bool room(std::size_t at, std::size_t count, std::size_t limit, std::string_view many);
    /// Holds the names of one kind to be unlike each other.
    void nameOnce(const Line& line, std::string_view kind, const std::string& name, std::map<std::string, int>& names);

    Faults faults_;
    Scene scene_;
    std::vector<Fault> warnings_;
    Line line_;
    Form form_ = Form::unknown;
    std::vector<Level> levels_;  // the last record of each level
    bool at_head_ = false;  // nothing but comments since the first line
    int world_line_ = 0, render_line_ = 0, physics_line_ = 0;
    std::map<std::string, int> camera_names_, light_names_, material_names_, object_names_;  // and their lines

    struct Meant {  // a material of an object, which may be defined further down
        std::size_t object;
        Place place;
        std::string name;  // empty: index
        int index = -1;
    };
    std::vector<Meant> materials_meant_;
    std::vector<Place> object_places_;
    std::vector<int> children_;  // of each object
};

}  // namespace mb::text
