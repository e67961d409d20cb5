// gl_window: soft shadows under casters that orbit, and everything to turn on and off; time and error beside it.
//
//   options -> window -> mesh, lightmaps -> each frame: casters move, map on GL, error on the CPU, scene, panel
#include "stage.hpp"

#include <gallery/failure.hpp>
#include <gallery/picture.hpp>
#include <gallery/score.hpp>

#pragma GCC diagnostic ignored "-Wnull-dereference" // g++ 12 sees one in std::string, once CLI11 is inlined
#include <CLI/CLI.hpp>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>

using namespace gl_window;
using gallery::failure;

namespace {

struct options {
    int width = 1200, height = 720;
    int frames = 0; ///< 0: until the window is closed
    std::string screenshot, mesh;
    choice chosen;
    bool grid = false;
};

/// The last so many values of something that is measured each frame.
struct history {
    std::array<float, 120> values{};
    int next = 0;

    void add(double v) { values[static_cast<std::size_t>(next++ % 120)] = static_cast<float>(v); }
    [[nodiscard]] float last() const { return next == 0 ? 0.0f : values[static_cast<std::size_t>((next - 1) % 120)]; }
    void plot(const char* name) const {
        ImGui::PlotLines(name, values.data(), 120, next % 120, nullptr, 0.0f, FLT_MAX, ImVec2(0.0f, 36.0f));
    }
};

class window {
  public:
    window(int width, int height) {
        glfwSetErrorCallback([](int, const char* words) { last_words() = words; });
        if (glfwInit() == 0) throw failure("no window can be opened: " + last_words());
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        handle_ = glfwCreateWindow(width, height, "gnomon", nullptr, nullptr);
        if (handle_ == nullptr) {
            glfwTerminate();
            throw failure("no window with OpenGL 3.3 can be opened: " + last_words());
        }
        glfwMakeContextCurrent(handle_);
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
        ImGui_ImplGlfw_InitForOpenGL(handle_, true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~window() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        glfwDestroyWindow(handle_);
        glfwTerminate();
    }
    window(const window&) = delete;
    window& operator=(const window&) = delete;

    [[nodiscard]] GLFWwindow* handle() const { return handle_; }
    /// Pixels, which may be more than the size that was asked for.
    [[nodiscard]] gnomon::extent size() const {
        gnomon::extent pixels;
        glfwGetFramebufferSize(handle_, &pixels.width, &pixels.height);
        return pixels;
    }

  private:
    static std::string& last_words() {
        static std::string words;
        return words;
    }
    GLFWwindow* handle_ = nullptr;
};

/// Everything between the window and the map.
class viewer {
  public:
    viewer(const gl::context& c, const gallery::mesh& m, const options& o)
        : c_(c), run_(c), mesh_(m), scene_(orbits()), frame_(frame_of(scene_, {map_side, map_side}, 8)),
          on_gpu_(c, scene_, m, frame_), stage_(c, scene_, gallery::bake(scene_, gallery::ray_world(scene_, m)), frame_),
          points_(points_of(scene_, frame_, 0.07f)), chosen_(o.chosen), grid_(o.grid) {
        choose(chosen_);
    }

    void draw(double seconds, gnomon::extent pixels) {
        move_casters(scene_, seconds);
        c_.gl->Finish();
        const auto start = std::chrono::steady_clock::now();
        map_->draw(on_gpu_);
        c_.gl->Finish();
        milliseconds_.add(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        if (measure_) measure();

        c_.gl->BindFramebuffer(gl::enums::framebuffer, 0);
        c_.gl->Viewport(0, 0, pixels.width, pixels.height);
        const glm::mat4 camera = camera_of(scene_, static_cast<float>(pixels.width) / static_cast<float>(pixels.height));
        stage_.draw(on_gpu_.mesh(), map_->soft_texture(), camera);
        if (grid_) draw_grid(camera);
    }

    /// The panel. What is chosen in it counts from the next frame on.
    void panel() {
        ImGui::SetNextWindowPos(ImVec2(12.0f, 12.0f), ImGuiCond_FirstUseEver);
        ImGui::Begin("shadow map", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
        const choice now = controls(chosen_);
        ImGui::Checkbox("tiles that are filtered", &grid_);
        ImGui::SameLine();
        ImGui::Checkbox("measure error", &measure_);
        ImGui::Separator();
        numbers();
        ImGui::End();
        if (!(now == chosen_)) choose(now);
    }

    [[nodiscard]] double rmse() const { return static_cast<double>(rmse_.last()); }
    [[nodiscard]] std::size_t points() const { return points_.size(); }

  private:
    void choose(const choice& c) {
        map_ = make_map(c, run_);
        if (map_->problem()) throw failure(map_->problem().sentence);
        stage_.decide_by(map_->receive_text());
        chosen_ = c;
    }

    static choice controls(choice now) {
        constexpr std::array biases{gnomon::bias_towards::light, gnomon::bias_towards::none, gnomon::bias_towards::shadow};
        int kernel = now.gaussian ? 0 : 1, radius = now.wide ? 1 : 0,
            towards = static_cast<int>(std::find(biases.begin(), biases.end(), now.towards) - biases.begin());
        ImGui::Combo("texel format", &now.format, format_names, 4);
        ImGui::Combo("kernel", &kernel, "gaussian\0box\0");
        ImGui::Combo("radius", &radius,
                     "3 texels\0"
                     "8 texels\0");
        ImGui::Checkbox("far bound", &now.far_bound);
        ImGui::SameLine();
        ImGui::Checkbox("translucency", &now.translucency);
        ImGui::Combo("bias", &towards, "towards light\0none\0towards shadow\0");
        now.gaussian = kernel == 0;
        now.wide = radius == 1;
        now.towards = biases[static_cast<std::size_t>(towards)];
        return now;
    }
    void numbers() const {
        constexpr int all_tiles = map_side / tile_size * (map_side / tile_size);
        ImGui::Text("map %d x %d, %d bytes a texel, %d of %d tiles", map_side, map_side, map_->bytes_per_texel(),
                    map_->tiles().count(), all_tiles);
        ImGui::Text("clear, cast and filter: %.2f ms", static_cast<double>(milliseconds_.last()));
        milliseconds_.plot("ms");
        ImGui::Text("error: RMSE %.4f, worst %.3f", static_cast<double>(rmse_.last()), worst_);
        rmse_.plot("RMSE");
        ImGui::TextDisabled(
            "of shadow intensity at %d points, against exact\npercentage-closer filtering of the float32\nmap by the CPU, with "
            "far bound and glass",
            static_cast<int>(points_.size()));
    }

    void measure() {
        const gallery::exact_map exact = exact_map_of(scene_, mesh_, frame_);
        const gallery::score s = gallery::compare(map_->receive(points_), exact_shadow(exact, points_, map_->weights()));
        rmse_.add(s.rmse);
        worst_ = s.max_error;
    }

    /// The filtered tiles, where the light would put them on the deck.
    void draw_grid(const glm::mat4& camera) const {
        const glm::dmat4 to_world = glm::inverse(frame_.matrix());
        const ImVec2 screen = ImGui::GetIO().DisplaySize;
        const auto corner = [&](int x, int y) {
            const glm::dvec4 a = to_world * glm::dvec4(x, y, 0.0, 1.0), b = to_world * glm::dvec4(x, y, 1.0, 1.0);
            const glm::vec4 p = camera * glm::vec4(a + (b - a) * (a.y / (a.y - b.y)));
            return ImVec2((p.x / p.w + 1.0f) * 0.5f * screen.x, (1.0f - p.y / p.w) * 0.5f * screen.y);
        };
        for_each_region(map_->tiles(), [&](gnomon::texel_rect r) {
            for (int y = r.y0; y < r.y1; y += tile_size)
                for (int x = r.x0; x < r.x1; x += tile_size)
                    ImGui::GetBackgroundDrawList()->AddQuad(corner(x, y), corner(x + tile_size, y),
                                                            corner(x + tile_size, y + tile_size), corner(x, y + tile_size),
                                                            IM_COL32(30, 60, 140, 120));
        });
    }

    const gl::context& c_;
    gl::backend run_;
    const gallery::mesh& mesh_;
    gallery::scene scene_;
    gnomon::light_frame frame_;
    gl_headless::gpu_scene on_gpu_;
    stage stage_;
    gallery::receivers points_;
    choice chosen_;
    bool grid_, measure_ = true;
    std::unique_ptr<shadow_map> map_{};
    history milliseconds_{}, rmse_{};
    double worst_ = 0.0;
};

/// What the window shows, as PNG.
void write_screenshot(const gl::context& c, gnomon::extent pixels, const std::string& file) {
    const gl::state_guard guard(c);
    c.gl->BindFramebuffer(gl::enums::framebuffer, 0);
    std::vector<unsigned char> read(4 * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
    c.gl->ReadPixels(0, 0, pixels.width, pixels.height, gl::enums::rgba, gl::enums::type_unsigned_byte, read.data());
    gallery::picture picture(pixels.width, pixels.height);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x)
            for (int i = 0; i < 3; ++i)
                picture.data()[3 * (y * pixels.width + x) + i] =
                    read[static_cast<std::size_t>(4 * ((pixels.height - 1 - y) * pixels.width + x) + i)];
    std::ofstream stream(file, std::ios::binary);
    const std::string bytes = png(picture);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) throw failure("cannot write '" + file + "'");
}

void run(const options& o) {
    const window shown(o.width, o.height);
    const gl::functions functions = gl::load(glfwGetProcAddress);
    const auto context = gl::context::of(functions);
    if (!context) throw failure(context.error().sentence);
    const gallery::mesh m = o.mesh.empty() ? gallery::torus_knot() : gallery::load_obj(o.mesh);
    viewer all(*context, m, o);
    for (int frame = 0; glfwWindowShouldClose(shown.handle()) == 0 && (o.frames == 0 || frame < o.frames); ++frame) {
        glfwPollEvents();
        const gnomon::extent pixels = shown.size();
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        if (!pixels.empty()) all.draw(o.frames == 0 ? glfwGetTime() : frame / 30.0, pixels);
        all.panel();
        ImGui::Render();
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        if (frame + 1 == o.frames && !o.screenshot.empty()) write_screenshot(*context, pixels, o.screenshot);
        glfwSwapBuffers(shown.handle());
    }
    if (o.frames > 0) std::printf("%d frames, RMSE %.4f at %zu points\n", o.frames, all.rmse(), all.points());
}

/// False where the program is to end with `exit_code`.
bool parse(int argc, char** argv, options& o, int& exit_code) {
    CLI::App app("Soft shadows under casters that orbit: turn format, kernel and effects on and off, and see time and error.",
                 "gnomon_gl_window");
    const std::map<std::string, int> formats{{"8", 0}, {"16", 1}, {"half", 2}, {"32", 3}};
    const std::map<std::string, gnomon::bias_towards> biases{
        {"light", gnomon::bias_towards::light}, {"none", gnomon::bias_towards::none}, {"shadow", gnomon::bias_towards::shadow}};
    bool box = false, narrow = false, unbounded = false, opaque = false;
    app.add_option("--frames", o.frames, "end after N frames, 1/30 s apart")->type_name("N")->check(CLI::Range(1, 1000000));
    app.add_option("--screenshot", o.screenshot, "write the last of the frames as PNG")->type_name("FILE")->needs("--frames");
    app.add_option("--mesh", o.mesh, "OBJ file that casts the shadows [a torus knot]")->type_name("FILE");
    app.add_option("--format", o.chosen.format, "8, 16, half or 32 [16]")->transform(CLI::CheckedTransformer(formats));
    app.add_option("--bias", o.chosen.towards, "light, none or shadow [shadow]")->transform(CLI::CheckedTransformer(biases));
    app.add_flag("--box", box, "filter with a box, not a gaussian");
    app.add_flag("--narrow", narrow, "radius 3, not 8");
    app.add_flag("--no-far-bound", unbounded, "shadows fall through the deck");
    app.add_flag("--no-translucency", opaque, "glass casts as stone does");
    app.add_flag("--grid", o.grid, "show the tiles that are filtered");
    try {
        app.parse(argc, argv);
        o.chosen.gaussian = !box;
        o.chosen.wide = !narrow;
        o.chosen.far_bound = !unbounded;
        o.chosen.translucency = !opaque;
        return true;
    } catch (const CLI::CallForHelp&) {
        std::printf("%s", app.help().c_str());
        exit_code = 0;
    } catch (const CLI::ParseError& e) {
        std::fprintf(stderr, "gnomon_gl_window: %s; see --help\n", e.what());
        exit_code = 1;
    }
    return false;
}

} // namespace

int main(int argc, char** argv) {
    options o;
    int exit_code = 0;
    if (!parse(argc, argv, o, exit_code)) return exit_code;
    try {
        run(o);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gnomon_gl_window: %s\n", e.what());
    }
    return 1;
}
