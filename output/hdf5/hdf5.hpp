#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

namespace wormdrive {

/// A result that could not be written or read; what() names the file and the reason.
struct OutputFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that is not what a result is: its name as it was given, and what() is wrong with it.
struct ReadFault : OutputFault {
  ReadFault(std::string file, const std::string& what) : OutputFault(what), path(std::move(file)) {}
  std::string path;
};

/// An HDF5 identifier that closes itself.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  /// Takes over an identifier; throws OutputFault naming the action, with the system's reason, if HDF5 refused. The
  /// action is put into words before the call: the next call of HDF5 forgets the reason.
  Hdf5Handle(hid_t id, Close closer, const std::string& action);
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0 && close_(id_) < 0) note_loss();
  }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): made to be passed to HDF5

  /// Closes now, so that a failure can be told; throws OutputFault naming the action.
  void close(const std::string& action);

  /// Throws OutputFault naming the action if a handle that closed itself since they were forgotten lost what it had to
  /// write, as on a full disk.
  static void reject_losses(const std::string& action);
  static void forget_losses();

 private:
  static void note_loss();

  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// The file in which an object lies, as it was opened.
std::string file_of(hid_t object);

/// Throws OutputFault naming the action, with the system's reason, if an HDF5 call failed.
void check_hdf5(herr_t status, const std::string& action);

/// Whether a file begins like an HDF5 file.
bool is_hdf5(const std::string& path);
Hdf5Handle create_hdf5(const std::string& path);
Hdf5Handle open_hdf5(const std::string& path);
/// The same for a file in which another program writes values, but nothing of the structure: it is not asked for a
/// lock.
Hdf5Handle open_hdf5_while_written(const std::string& path);
/// Opens a file to write on in it.
Hdf5Handle reopen_hdf5(const std::string& path);
Hdf5Handle create_group(hid_t parent, const std::string& name);

void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, const std::vector<std::int8_t>& values);

/// Whole number of an attribute of an object; throws ReadFault if it is absent or something else.
std::int64_t read_integer_attribute(hid_t object, const std::string& name);
/// Number of an attribute; throws ReadFault if it is absent or something else.
double read_number_attribute(hid_t object, const std::string& name);
/// Text of a string attribute of an object; throws ReadFault if it is absent or something else.
std::string read_text_attribute(hid_t object, const std::string& name);
/// Opens what a path leads to from a file or group; throws ReadFault if that is nothing, or behind a link: links lead
/// to other files, or in circles, and no result has any.
Hdf5Handle open_object(hid_t place, const std::string& path);

}  // namespace wormdrive
