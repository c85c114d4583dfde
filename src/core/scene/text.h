#pragma once
// Scenes as text: reading, writing, files, and one knob at a time. The format has version 1; the form before it is read
// too and written as version 1. Of a file's comments the one at its head, between the
// first line and the next record, is kept; those further down are not.
//
// Numbers: -?(digits[.digits] | .digits)[e[+-]digits], of at most 128 characters, the same under every locale. A leading
// '+', hexadecimal, inf and nan are refused, and so is a number that no double holds (1e400, 1e-400).
// Words: [A-Za-z_][A-Za-z0-9_.-]*; any other text stands in quotes.
#include "core/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mb {

/// What is wrong at a place of a text. Lines and columns count from 1; a column is a character, not a byte.
struct Fault {
    int line = 1, column = 1;
    std::string message;  // what is wrong, what was expected
};

inline constexpr std::size_t kMaxFaults = 20;  // of one text; reading stops there

struct ReadResult {
    Scene scene;                  // empty if there is a fault
    std::vector<Fault> faults;    // in the order of the text
    std::vector<Fault> warnings;  // what this version reads and keeps but cannot show as meant; at most kMaxFaults
    int render_line = 1;          // where the render record stands, for what is wrong with its knobs together
    bool ok() const { return faults.empty(); }
};

/// The scene of a text. Takes time and memory in proportion to the text, whatever its bytes.
ReadResult readScene(std::string_view bytes);

/// The text of a scene, ending with a line end; readScene gives the same scene back, to the bit. A key is written where it
/// is required or its value is not the record's default. Control characters and broken UTF-8 in names, which no text may
/// hold, are replaced.
std::string writeScene(const Scene& scene);

/// "FILE:LINE:COLUMN: error: what is wrong, what was expected", or another word for "error".
std::string describe(const Fault& fault, std::string_view file, std::string_view kind = "error");

struct LoadResult : ReadResult {
    std::string disk_fault;  // why the file could not be read at all ("FILE: No such file or directory"), or empty
    bool ok() const { return disk_fault.empty() && faults.empty(); }
};

/// Reads a regular file; whatever else stands at the path (a folder, a pipe, a device) is a fault of the disk. Never waits.
LoadResult loadScene(const std::filesystem::path& path);

/// Puts the scene's text at the path, all of it or nothing: other programs see the old file or the new one, whole. A link
/// is followed and stays; the file's permissions stay. Says why it failed; the old file is then as it was. A scene that
/// readScene would refuse (a value out of its range) is not saved.
std::optional<std::string> saveScene(const std::filesystem::path& path, const Scene& scene);

/// Sets one key of the world, render or physics record, as in `--set samples=4`. Says what is wrong, if anything; the
/// scene is then as it was.
std::optional<std::string> setKnob(Scene& scene, std::string_view key_value);

}  // namespace mb
