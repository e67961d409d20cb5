// gallery: a folder that receives all files of a run or none.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gallery {

/// Collects files under temporary names; `commit` gives them their own. Without it nothing of the run stays behind.
class output_folder {
  public:
    /// Makes the folder if need be, and finds out now rather than after the work whether it can be written.
    explicit output_folder(const std::string& path);
    output_folder(const output_folder&) = delete;
    output_folder& operator=(const output_folder&) = delete;
    ~output_folder();

    void write(const std::string& name, std::string_view bytes);
    void commit();
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return folder_; }

  private:
    void remove_made_folders() const noexcept;

    struct file {
        std::filesystem::path temporary;
        std::filesystem::path final_name;
    };

    std::filesystem::path folder_;
    std::filesystem::path topmost_made_; ///< the outermost folder that this run made; empty if it was all there
    std::vector<file> files_;
    bool committed_ = false;
};

} // namespace gallery
