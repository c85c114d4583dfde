#pragma once
// Where OpenGL's functions come from.
//
// A program with a window may also render without one. Debian's GLEW asks glXGetProcAddressARB for every function, which
// knows nothing of an OSMesa context; and the functions of OpenGL 1.1 are linked, not loaded, so they would always be
// those of whichever library the linker met first. So this program defines and exports glXGetProcAddressARB itself
// (the executable is linked with -rdynamic), answers from the loader of the context now in use, and reaches the functions
// of 1.1 through a table filled the same way.
#include <string>

namespace mb {

using AnyFunction = void (*)();
using GetFunction = AnyFunction (*)(const char* name);

/// Makes `get` the source of all OpenGL functions, with its context current. Returns what is wrong, or nothing.
std::string loadOpenGl(GetFunction get);

}  // namespace mb
