#pragma once
// A shader's text with only what its main() uses: what stands behind switches that are not set is left out, and so is every
// definition, function, structure and variable that nothing left in the text names.
#include "core/render/compose.h"

namespace mb {

/// The stripped text, its places still traceable. It means the same to a compiler.
///
/// It reads the library's own style: `#ifdef`, `#ifndef`, `#else` and `#endif` of names that the text defines itself (those that
/// begin with GL_ are the driver's, and stay), and declarations that begin at a line's first column and end with a line's last.
Composed stripped(const Composed& composed);

}  // namespace mb
