// gallery: what is wrong with the world, in one sentence for the user.
#pragma once

#include <stdexcept>

namespace gallery {

/// Ends the program with its message on stderr; thrown only for what the user can mend: a mesh, a folder, a disk.
struct failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace gallery
