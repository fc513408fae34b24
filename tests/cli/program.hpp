#pragma once
// What the tests of the program share: a folder of its own, the program run in it, and a look into result files.
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "output/hdf5/stored_column.hpp"
#include "scenario_texts.hpp"

namespace wormdrive::test {

/// How a program ended and what it said.
struct Outcome {
  int exit = -1;  ///< exit code, or 128 + signal
  std::string out, err;
};

/// A program that runs in a folder of its own choice; what it prints is collected when it has ended.
class Process {
 public:
  Process(const std::vector<std::string>& words, const std::filesystem::path& folder,
          std::optional<rlim_t> largest_file = {}) {
    if (pipe(out_.data()) != 0 || pipe(err_.data()) != 0) throw std::runtime_error("no pipe");
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(out_[1], STDOUT_FILENO);
      dup2(err_[1], STDERR_FILENO);
      for (const int end : {out_[0], out_[1], err_[0], err_[1]}) ::close(end);
      const rlimit limit{largest_file.value_or(RLIM_INFINITY), largest_file.value_or(RLIM_INFINITY)};
      if (chdir(folder.c_str()) == 0 && setrlimit(RLIMIT_FSIZE, &limit) == 0) execv(argv[0], argv.data());
      _exit(127);
    }
    ::close(out_[1]);
    ::close(err_[1]);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (pid_ <= 0) return;
    kill();
    wait();
  }

  void kill(int signal = SIGKILL) const { ::kill(pid_, signal); }
  Outcome wait() {
    Outcome outcome;
    std::array<pollfd, 2> ends{{{out_[0], POLLIN, 0}, {err_[0], POLLIN, 0}}};
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
      poll(ends.data(), ends.size(), -1);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        if (ends[k].fd < 0 || ends[k].revents == 0) continue;
        std::array<char, 65536> buffer;
        const ssize_t count = read(ends[k].fd, buffer.data(), buffer.size());
        if (count > 0) {
          (k == 0 ? outcome.out : outcome.err).append(buffer.data(), static_cast<std::size_t>(count));
        } else {
          ::close(ends[k].fd);
          ends[k].fd = -1;
        }
      }
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
  }

 private:
  pid_t pid_ = -1;
  std::array<int, 2> out_{}, err_{};
};

/// An empty folder that disappears with its contents.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "wormdrive_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name, std::ios::binary).rdbuf();
    return text.str();
  }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) all.insert(entry.path().filename().string());
    return all;
  }

  /// Runs `wormdrive words...` here.
  Outcome run(std::vector<std::string> words, std::optional<rlim_t> largest_file = {}) const {
    words.insert(words.begin(), WORMDRIVE_PROGRAM);
    return Process(words, path_, largest_file).wait();
  }

 private:
  std::filesystem::path path_;
};

inline std::string shipped(const std::string& scenario) { return WORMDRIVE_SCENARIOS "/" + scenario; }
/// Reads a run with h5py and prints one line a column.
inline const std::string h5py_script = WORMDRIVE_TESTS "/output/read_with_h5py.py";

/// A text with one of its parts replaced; the part has to occur.
inline std::string edited(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::invalid_argument("nothing to replace: " + part);
  return text.replace(at, part.size(), by);
}
inline std::string good_but(const std::string& part, const std::string& by) { return edited(good_scenario, part, by); }

/// Names of the members of a group of an HDF5 file.
inline std::vector<std::string> members(hid_t group) {
  H5G_info_t info;
  H5Gget_info(group, &info);
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::array<char, 256> name{};
    H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    names.emplace_back(name.data());
  }
  return names;
}

/// Every dataset of a group byte for byte.
inline std::map<std::string, std::vector<char>> bytes(hid_t file, const std::string& group) {
  const Hdf5Handle table(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose, "cannot open " + group);
  std::map<std::string, std::vector<char>> all;
  for (const std::string& name : members(table)) {
    const Hdf5Handle dataset(H5Dopen2(table, name.c_str(), H5P_DEFAULT), H5Dclose, "cannot open " + name);
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, "no type"),
        space(H5Dget_space(dataset), H5Sclose, "no space");
    std::vector<char>& content = all[name];
    content.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type));
    check_hdf5(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data()), "cannot read " + name);
  }
  return all;
}

}  // namespace wormdrive::test
