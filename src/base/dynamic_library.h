// SPDX-License-Identifier: Apache-2.0
// A library that is loaded when a file asks for it: the program starts without it.
// in: the names of a library and of its functions -> out: pointers to them.
// POSIX, dlopen and dlsym. Only builds that load a library include this: a static one could not.
#pragma once
#include <dlfcn.h>

namespace pileus {

/// It stays loaded: its threads, tables and what it keeps of open files may outlive a call.
class DynamicLibrary {
public:
    explicit DynamicLibrary(const char* name)
        : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {}

    bool is_there() const { return handle_ != nullptr; }

    /// Null where there is no such function.
    template <class Function>
    void find(const char* symbol, Function*& to) {
        // Without a handle dlsym would look through the program itself.
        to = is_there() ? reinterpret_cast<Function*>(dlsym(handle_, symbol)) : nullptr;
        whole_ = whole_ && to != nullptr;
    }

    /// It is there, and so was all that was looked for.
    bool is_whole() const { return is_there() && whole_; }

private:
    void* handle_;
    bool whole_ = true;
};

}  // namespace pileus
