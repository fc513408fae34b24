#pragma once
#include <string>

#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/output_lock.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// An HDF5 file that exists as NAME.part until it is complete: the final name never holds a partial file. Where NAME is
/// a symbolic link it is the file at its end that is written.
class PartFile {
 public:
  /// Creates NAME.part for a result of a kind; throws OutputFault if the place cannot be written, or if what is there
  /// may not be replaced.
  PartFile(const std::string& path, std::string_view kind, Replace replace = Replace::same_kind);
  /// The same for one who holds the lock of what it becomes.
  PartFile(const std::string& path, OutputLock lock, std::string_view kind, Replace replace);
  /// Opens the NAME.part that a program left, to go on with it, for one who holds the lock; it stays whatever happens.
  static PartFile reopened(const std::string& path, std::string_view kind, Replace replace = Replace::same_kind) {
    return {path, kind, replace, Left{}};
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  /// Deletes a part that was neither finished nor kept: what could not be written whole is not left behind.
  ~PartFile();

  hid_t file() const { return file_; }
  const std::string& part_path() const { return part_path_; }
  const std::string& path() const { return path_; }

  /// Makes all that was written so far readable even if the program dies.
  void flush();
  /// Closes the file and gives it its final name. Every other handle into it must be closed before.
  void finish();
  /// Gives the final name to another file, which has all of this one, and removes NAME.part.
  void give_way_to(const std::string& other);
  /// Makes the part readable and lets it stay although it is not complete.
  void keep();
  /// Lets a part that was there before go, too, unless it is finished.
  void give_up() { stays_ = false; }

 private:
  struct Left {};
  PartFile(const std::string& path, std::string_view kind, Replace replace, Left);

  void create(std::string_view kind, Replace replace);

  std::string path_, part_path_;
  OutputLock lock_;  ///< given back after all else
  Hdf5Handle file_;
  bool stays_ = false;
};

/// Whether a program has a file open for writing.
bool is_being_written(const std::string& path);

/// HDF5 locks a file that it writes, but empties it before it asks for the lock. Throws OutputFault where a program has
/// it.
void reject_if_being_written(const std::string& part_path);

/// Waits until a file is on disk: a rename may otherwise outlive its data in a power cut. Throws OutputFault.
void synchronise(const std::string& path);

/// Title, kind and provenance that every result file carries as root attributes.
struct Provenance {
  std::string kind;  ///< "run", "statics", "steady", "efficiency", "sweep", "rare" or "diagnosis"
  std::string title;
  std::string scenario;      ///< the resolved scenario as TOML text
  std::string command_line;  ///< as typed
};
void write_provenance(hid_t file, const Provenance& provenance);

}  // namespace wormdrive
