#include "output.hpp"

#include "failure.hpp"

#include <fstream>

namespace gallery {

namespace {
std::filesystem::path first_missing(const std::filesystem::path& folder) {
    std::filesystem::path missing;
    std::error_code ignored;
    for (auto p = folder; !p.empty() && !std::filesystem::exists(p, ignored); p = p.parent_path()) {
        missing = p;
        if (p == p.parent_path()) break;
    }
    return missing;
}
} // namespace

output_folder::output_folder(const std::string& path) {
    std::error_code error;
    folder_ = std::filesystem::absolute(path, error).lexically_normal();
    if (!folder_.has_filename()) folder_ = folder_.parent_path(); // "out/" is "out"
    topmost_made_ = first_missing(folder_);
    std::filesystem::create_directories(folder_, error);
    const auto probe = folder_ / ".gnomon_gallery.probe";
    const bool writable = !error && std::filesystem::is_directory(folder_, error) && std::ofstream(probe).put('\n').flush().good();
    std::filesystem::remove(probe, error);
    if (writable) return;
    remove_made_folders();
    throw failure("cannot write to the folder '" + path + "'");
}

output_folder::~output_folder() {
    if (committed_) return;
    std::error_code ignored;
    for (const file& f : files_) std::filesystem::remove(f.temporary, ignored);
    remove_made_folders();
}

void output_folder::remove_made_folders() const noexcept {
    std::error_code error;
    if (topmost_made_.empty()) return;
    for (auto p = folder_; std::filesystem::remove(p, error) && p != topmost_made_; p = p.parent_path()) {
    } // empty ones only
}

void output_folder::write(const std::string& name, std::string_view bytes) {
    const file& f = files_.emplace_back(file{folder_ / ("." + name + ".part"), folder_ / name});
    std::ofstream stream(f.temporary, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) throw failure("cannot write '" + f.final_name.string() + "'");
}

void output_folder::commit() {
    std::error_code error;
    for (const file& f : files_)
        if (std::filesystem::is_directory(f.final_name, error))
            throw failure("cannot replace the folder '" + f.final_name.string() + "' by a file");
    for (const file& f : files_) {
        std::filesystem::rename(f.temporary, f.final_name, error);
        if (error) throw failure("cannot write '" + f.final_name.string() + "': " + error.message());
    }
    committed_ = true;
}

} // namespace gallery
