#include <gnomon/gl/state.hpp>

#include "../support/fake_gl.hpp"
#include "../support/gl_state.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gl = gnomon::gl;
namespace enums = gnomon::gl::enums;

TYPE_TO_STRING_AS("dirty", gl::state_guard<gl::state_policy::dirty>);
TYPE_TO_STRING_AS("restore", gl::state_guard<gl::state_policy::restore>);

namespace {

constexpr int units = 4;

struct version {
    const char* text;
    std::vector<std::string> extensions;
};
const version versions[] = {{"3.3", {}},
                            {"3.3", {"GL_ARB_clip_control"}},
                            {"4.0", {}},
                            {"4.1", {}},
                            {"4.5", {}},
                            {"OpenGL ES 3.0", {}},
                            {"OpenGL ES 3.0", {"GL_EXT_clip_control", "GL_EXT_depth_clamp", "GL_EXT_clip_cull_distance"}},
                            {"OpenGL ES 3.1", {}},
                            {"OpenGL ES 3.2", {}}};

/// Changes all that a pass may: what a guard sets is set by it already. Leaves blending on, as a hostile host does, or off.
void pass(const gl::context& c, bool blends = true) {
    const gl::functions& f = *c.gl;
    const gl::framebuffer frame(c);
    const gl::vertex_array corners(c);
    const gl::buffer rectangles(c);
    const gl::program shader(c);
    const gl::texture map(c);
    f.BindFramebuffer(enums::framebuffer, frame.name());
    f.BindVertexArray(corners.name());
    f.BindBuffer(enums::array_buffer, rectangles.name());
    f.UseProgram(shader.name());
    f.ActiveTexture(enums::texture0 + units - 1);
    f.BindTexture(enums::texture_2d, map.name());
    f.Viewport(0, 0, 17, 19);
    f.Scissor(1, 2, 3, 4);
    for (const unsigned what : {enums::scissor_test, enums::blend, enums::depth_test, enums::cull_face}) f.Enable(what);
    f.ColorMask(0, 0, 1, 0);
    f.BlendEquation(enums::blend_max);
    f.BlendFunc(enums::one, enums::one);
    f.DepthFunc(enums::lequal);
    f.DepthMask(0);
    f.PixelStorei(enums::unpack_row_length, 3);
    f.UseProgram(0);
    if (!blends) f.Disable(enums::blend);
}

/// What a guard leaves to the pass, which sets it to its own.
const std::set<unsigned> set_by_pass{enums::draw_framebuffer_binding,
                                     enums::read_framebuffer_binding,
                                     enums::vertex_array_binding,
                                     enums::array_buffer_binding,
                                     enums::current_program,
                                     enums::viewport,
                                     enums::scissor_box,
                                     enums::texture_binding_2d};

/// The fake's whole memory, but for objects that came and went.
std::string differing(const test::fake_gl& fake, const std::map<test::fake_gl::key, test::fake_gl::values>& before) {
    std::string text;
    for (const auto& [where, now] : fake.state)
        if (const auto then = before.find(where); now != (then == before.end() ? test::fake_gl::values{} : then->second))
            text += std::to_string(where.first) + '[' + std::to_string(where.second) + "]; ";
    return text;
}

} // namespace

TEST_CASE("a restoring guard leaves all state as a hostile host had it") {
    for (const version& v : versions)
        for (int seed = 0; seed < 20; ++seed) {
            CAPTURE(v.text);
            CAPTURE(seed);
            test::fake_gl fake(v.text, v.extensions);
            const gl::context c = *gl::context::of(fake.table);
            {
                test::dice roll(static_cast<std::uint64_t>(seed));
                const gl::program engine(c);
                const test::hostile_host host(c, roll, units, engine.name());
                const auto before = fake.state;
                const auto seen = test::state_of(c, units);
                {
                    const gl::state_guard<gl::state_policy::restore> guard(c, units);
                    pass(c, seed % 2 == 0);
                    CHECK(differing(fake, before) != ""); // so there was something to restore
                }
                CHECK(differing(fake, before) == "");
                CHECK(test::differing_state(seen, test::state_of(c, units)) == "");
            }
            CHECK(fake.alive() == 0);
            CHECK(fake.wrong == "");
        }
}

TEST_CASE_TEMPLATE("under either policy a pass starts from one state, whatever the host left", Guard,
                   gl::state_guard<gl::state_policy::dirty>, gl::state_guard<gl::state_policy::restore>) {
    for (const version& v : versions) {
        CAPTURE(v.text);
        const auto known = [](auto state) { // what was never set is 0
            std::erase_if(
                state, [](const auto& s) { return s.second == test::fake_gl::values{} || set_by_pass.count(s.first.first) != 0; });
            return state;
        };
        const auto forced = [&](bool hostile) {
            test::fake_gl fake(v.text, v.extensions);
            const gl::context c = *gl::context::of(fake.table);
            test::dice roll(7);
            std::optional<test::hostile_host> host;
            if (hostile) host.emplace(c, roll, units, 0u);
            const Guard guard(c, units);
            CHECK(fake.wrong == "");
            return known(fake.state);
        };
        test::fake_gl fresh(v.text, v.extensions); // a new context's, but for what suits texels
        fresh.put(enums::dither, 0, 0);
        for (const unsigned packing : {enums::pack_alignment, enums::unpack_alignment}) fresh.put(packing, 0, 1);
        const auto expected = known(fresh.state);
        CHECK(expected.size() > 20);
        CHECK(forced(false) == expected);
        CHECK(forced(true) == expected);
    }
}

TEST_CASE("a dirty guard asks nothing of GL, and puts nothing back") {
    for (const version& v : versions) {
        test::fake_gl fake(v.text, v.extensions);
        const gl::context c = *gl::context::of(fake.table);
        fake.calls.clear();
        std::map<test::fake_gl::key, test::fake_gl::values> inside;
        {
            const gl::state_guard guard(c);
            inside = fake.state;
        }
        CHECK(differing(fake, inside) == "");
        CHECK(fake.calls["BindSampler"] == 4);
        for (const auto& call : fake.calls)
            CHECK_MESSAGE((call.first.substr(0, 3) != "Get" && call.first.substr(0, 2) != "Is"), call.first);
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("a guard of each policy makes as many calls as it says") {
    const auto calls_of = [](const char* version, auto&& guarded) {
        test::fake_gl fake(version);
        const gl::context c = *gl::context::of(fake.table);
        fake.order.clear();
        guarded(c);
        const auto asked = std::count_if(fake.order.begin(), fake.order.end(), [](const std::string& name) {
            return name.compare(0, 3, "Get") == 0 || name.compare(0, 2, "Is") == 0;
        });
        return std::pair{static_cast<int>(asked), static_cast<int>(fake.order.size())};
    };
    const auto dirty = [](const gl::context& c) { const gl::state_guard<gl::state_policy::dirty> guard(c); };
    const auto restores = [](const gl::context& c) { const gl::state_guard<gl::state_policy::restore> guard(c); };
    CHECK((calls_of("OpenGL ES 3.0", dirty) == std::pair{0, 33}));
    CHECK((calls_of("4.5", dirty) == std::pair{0, 54}));
    CHECK((calls_of("OpenGL ES 3.0", restores) == std::pair{49, 33 + 49 + 52}));
    CHECK((calls_of("4.5", restores) == std::pair{187, 54 + 187 + 161}));
}

TEST_CASE("no context is asked for a switch or a pixel store that it has not") {
    const auto listed = [](const char* version, std::vector<std::string> extensions = {}) {
        test::fake_gl fake(version, std::move(extensions));
        const gl::context c = *gl::context::of(fake.table);
        std::set<unsigned> switches, stores;
        gl::detail::for_each_switch(c, [&](unsigned what) { switches.insert(what); });
        gl::detail::for_each_pixel_store(c, [&](unsigned name, int) { stores.insert(name); });
        CHECK(stores.size() == (c.es ? 8 : 12));
        return switches;
    };
    const std::set<unsigned> everywhere = listed("OpenGL ES 3.0");
    CHECK(everywhere.size() == 8);
    const auto more = [&](const std::set<unsigned>& all) {
        std::set<unsigned> rest = all;
        for (const unsigned what : everywhere) CHECK(rest.erase(what) == 1);
        return rest;
    };
    const std::set<unsigned> distances{enums::clip_distance0,     enums::clip_distance0 + 1, enums::clip_distance0 + 2,
                                       enums::clip_distance0 + 3, enums::clip_distance0 + 4, enums::clip_distance0 + 5,
                                       enums::clip_distance0 + 6, enums::clip_distance0 + 7};
    CHECK((more(listed("OpenGL ES 3.1")) == std::set<unsigned>{enums::sample_mask}));
    CHECK((more(listed("OpenGL ES 3.0", {"GL_EXT_depth_clamp"})) == std::set<unsigned>{enums::depth_clamp}));
    CHECK(more(listed("OpenGL ES 3.0", {"GL_EXT_clip_cull_distance"})) == distances);
    std::set<unsigned> desktop{enums::color_logic_op,      enums::framebuffer_srgb, enums::polygon_smooth, enums::primitive_restart,
                               enums::sample_alpha_to_one, enums::sample_mask,      enums::depth_clamp};
    desktop.insert(distances.begin(), distances.end());
    CHECK(more(listed("3.3")) == desktop);
}

TEST_CASE("a restoring guard pauses transform feedback that runs, and leaves alone what is paused or inactive") {
    for (const char* version : {"4.0", "OpenGL ES 3.0"}) {
        test::fake_gl fake(version);
        const gl::context c = *gl::context::of(fake.table);
        {
            const gl::state_guard<gl::state_policy::restore> guard(c);
        }
        CHECK(fake.calls["PauseTransformFeedback"] == 0);
        fake.put(enums::transform_feedback_active, 0, 1);
        {
            const gl::state_guard<gl::state_policy::restore> guard(c);
            CHECK(fake.get(enums::transform_feedback_paused)[0] > 0);
            fake.order.clear();
        }
        CHECK(fake.get(enums::transform_feedback_paused)[0] < 1);
        CHECK(fake.order.back() == "ResumeTransformFeedback"); // its program is in use again
        fake.put(enums::transform_feedback_paused, 0, 1);
        {
            const gl::state_guard<gl::state_policy::restore> guard(c);
        }
        CHECK(fake.calls["PauseTransformFeedback"] == 1);
        CHECK(fake.calls["ResumeTransformFeedback"] == 1);
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("a context with a mode for each face of a polygon has both back") {
    test::fake_gl fake("3.3 Compatibility Profile");
    const gl::context c = *gl::context::of(fake.table);
    constexpr unsigned point = 0x1B00;
    c.gl->PolygonMode(enums::front, enums::line);
    c.gl->PolygonMode(enums::back_face, point);
    {
        const gl::state_guard<gl::state_policy::restore> guard(c);
    }
    CHECK(fake.get(enums::polygon_mode) == test::fake_gl::values{double{enums::line}, double{point}});
}

TEST_CASE("a context that answers with one mode for all polygons has it back for both faces") {
    test::fake_gl fake("3.3");
    const gl::context c = *gl::context::of(fake.table);
    fake.put(enums::polygon_mode, 0, enums::line);
    {
        const gl::state_guard<gl::state_policy::restore> guard(c);
        CHECK(fake.get(enums::polygon_mode)[0] < enums::fill + 1);
    }
    CHECK(fake.get(enums::polygon_mode) == test::fake_gl::values{double{enums::line}, double{enums::line}});
    fake.calls.clear();
    {
        const gl::state_guard<gl::state_policy::restore> guard(c);
    }
    CHECK(fake.calls["PolygonMode"] == 2); // a core profile takes no face alone
}

TEST_CASE("a restoring guard asks for nothing that a context has not") {
    for (const char* version : {"OpenGL ES 3.0", "OpenGL ES 3.1", "3.3", "4.5"}) {
        test::fake_gl fake(version);
        const gl::context c = *gl::context::of(fake.table);
        fake.table.GetIntegerv = [](unsigned name, int* to) {
            const bool es = test::fake_gl::current()->version.front() == 'O', latest = test::fake_gl::current()->version == "4.5";
            CHECK(name != 0);
            CHECK((name != enums::polygon_mode || !es));
            CHECK(((name != enums::transform_feedback_active && name != enums::transform_feedback_paused) || es || latest));
            CHECK(((name != enums::clip_origin && name != enums::clip_depth_mode) || latest));
            *to = static_cast<int>(test::fake_gl::current()->get(name)[0]);
        };
        fake.table.GetIntegeri_v = [](unsigned name, unsigned index, int* to) { // OpenGL ES 3.1 and 3.3 have one blend function
            CHECK(name != 0);
            CHECK(test::fake_gl::current()->version == "4.5");
            *to = static_cast<int>(test::fake_gl::current()->get(name, index)[0]);
        };
        {
            const gl::state_guard<gl::state_policy::restore> guard(c, 0);
        }
        CHECK(fake.wrong == "");
    }
}

TEST_CASE("of a context with two draw buffers and two viewports, a restoring guard keeps both of each") {
    test::fake_gl fake("4.5");
    for (const unsigned limit : {enums::max_draw_buffers, enums::max_viewports}) fake.put(limit, 0, 2);
    const gl::context c = *gl::context::of(fake.table);
    c.gl->Enablei(enums::blend, 1);
    c.gl->ColorMaski(1, 0, 1, 0, 1);
    c.gl->Enablei(enums::scissor_test, 1);
    c.gl->ViewportIndexedf(1, 0.5f, 1.5f, 2.5f, 3.5f);
    const auto before = fake.state;
    {
        const gl::state_guard<gl::state_policy::restore> guard(c);
    }
    CHECK(differing(fake, before) == "");
    CHECK(fake.calls["GetDoublev"] == 0); // each is asked for by its index
}

TEST_CASE("of a context with more of everything than there is room for, a restoring guard keeps the first") {
    test::fake_gl fake("4.5");
    for (const unsigned limit : {enums::max_draw_buffers, enums::max_viewports, enums::max_clip_distances}) fake.put(limit, 0, 64);
    const gl::context c = *gl::context::of(fake.table);
    c.gl->Enable(enums::clip_distance0);
    c.gl->Enable(enums::clip_distance0 + 24); // the 40th switch
    const gl::sampler first(c);
    c.gl->BindSampler(0, first.name());
    fake.calls.clear();
    {
        const gl::state_guard<gl::state_policy::restore> guard(c, 8);
    }
    CHECK(fake.calls["ColorMaski"] == 16);
    CHECK(fake.calls["DepthRangeIndexed"] == 16);
    CHECK(fake.calls["BindSampler"] == 2 * 8);
    CHECK(fake.get(enums::clip_distance0)[0] > 0);
    CHECK(fake.get(enums::clip_distance0 + 24)[0] > 0);
    for (unsigned i = 25; i < 64; ++i) CHECK(fake.get(enums::clip_distance0 + i)[0] <= 0);
    CHECK(static_cast<unsigned>(fake.get(enums::sampler_binding)[0]) == first.name());
}
