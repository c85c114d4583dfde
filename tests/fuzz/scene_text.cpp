// Whatever the bytes: the reader ends, and what it reads can be written and read again, to the same scene and text.
#include "core/scene/text.h"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const mb::ReadResult read = mb::readScene({reinterpret_cast<const char*>(data), size});
    if (read.faults.size() > mb::kMaxFaults || read.warnings.size() > mb::kMaxFaults) std::abort();
    if (!read.ok()) return 0;
    const std::string text = mb::writeScene(read.scene);
    const mb::ReadResult again = mb::readScene(text);
    if (!again.ok() || !mb::sameScene(read.scene, again.scene) || mb::writeScene(again.scene) != text) std::abort();
    return 0;
}
