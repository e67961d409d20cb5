// The GPU as one of the backends that suites run over.
#pragma once

#include "backends.hpp"
#include "egl.hpp"

#include <gnomon/gl/soft_shadow_map.hpp>

namespace test {

/// GL has no double, so of half and float it filters as scalar does by the fast kernel.
template <gnomon::gl::state_policy Policy, gnomon::texel_format Texel, gnomon::kernel Kernel>
struct filters_as<gnomon::gl::backend_of<Policy>, Texel, Kernel> {
    using kernel = gnomon::gl::kernel_in_gl<Texel, Kernel>;
};

/// Calls suite(backend) in every context.
template <typename Suite> void on_gl(Suite&& suite) {
    in_every_gl_context([&](const gnomon::gl::context& c) { suite(gnomon::gl::backend(c)); });
}
/// The same where maps of the texel can be had.
template <gnomon::texel_format Texel, typename Suite> void on_gl_with(Suite&& suite) {
    in_every_gl_context([&](const gnomon::gl::context& c) {
        if (const auto why = gnomon::gl::supports<Texel>(c)) return skip(why.sentence);
        suite(gnomon::gl::backend(c));
    });
}

} // namespace test
