#pragma once
// A library looked for when the program runs, so that the program also runs where it is missing.
#include <dlfcn.h>

#include <initializer_list>
#include <string>
#include <type_traits>

namespace mb {

class Library {
public:
    /// The first of `files` that is installed. `title` begins every message.
    Library(std::string title, std::initializer_list<const char*> files) : title_(std::move(title)) {
        for (const char* name : files)
            if (!file_) file_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (!file_) why_ = title_ + ": " + *(files.end() - 1) + " is not installed";
    }
    /// Sets a pointer to the function of that name; where it is missing, why() says so.
    template <class Function> void find(Function*& function, const char* name) {
        function = file_ ? reinterpret_cast<Function*>(dlsym(file_, name)) : nullptr;
        if (file_ && !function) why_ = title_ + ": it lacks " + name;
    }
    const std::string& why() const { return why_; }  // empty: all that was asked for is there

private:
    std::string title_, why_;
    void* file_ = nullptr;  // never closed: a context may live to the end of the program
};

}  // namespace mb
