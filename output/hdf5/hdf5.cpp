#include "output/hdf5/hdf5.hpp"

#include <atomic>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace wormdrive {
namespace {

/// The errno of the call of the system that failed behind the last call of HDF5, as HDF5 has noted it down; 0 if it was
/// HDF5 that refused. By now errno itself may be that of something else, as of the search for HDF5's plugins.
int system_error() {
  int number = 0;
  const auto look = [](unsigned, const H5E_error2_t* entry, void* found) {
    constexpr std::string_view before = "errno = ";
    const std::string_view text = entry->desc;
    const std::size_t at = text.rfind(before);  // a file's name with these words would stand before it
    if (at == std::string_view::npos) return herr_t{0};
    std::from_chars(text.data() + at + before.size(), text.data() + text.size(), *static_cast<int*>(found));
    return herr_t{1};  // the innermost is the cause
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &number);
  return number;
}

std::string with_reason(const std::string& action, int number = system_error()) {
  return number != 0 ? action + ": " + std::strerror(number) : action;
}

constexpr int no_loss = -1;
std::atomic<int> loss{no_loss};  ///< why the latest handle that closed itself could not write

/// Before anything is asked of HDF5. Diagnostics are told once, by the exception. And its clean-up at the end of the
/// program is not wanted: handles close themselves, and what a full disk left open makes it crash.
void prepare_hdf5() {
  [[maybe_unused]] static const bool done = [] {
    H5dont_atexit();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
}

std::string writing(hid_t object, const std::string& attribute) {
  return "cannot write attribute " + attribute + " to " + file_of(object);
}

template <class Value>
void write_scalar(hid_t object, const std::string& name, hid_t type, const Value& value) {
  const std::string action = writing(object, name);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, action);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, action);
  check_hdf5(H5Awrite(attribute, type, &value), action);
}

Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot describe text");
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Close closer, const std::string& action) : id_(id), close_(closer) {
  if (id < 0) throw OutputFault(with_reason(action));
}

void Hdf5Handle::close(const std::string& action) {
  if (id_ < 0) return;
  check_hdf5(close_(std::exchange(id_, -1)), action);
}

void Hdf5Handle::note_loss() { loss = system_error(); }

void Hdf5Handle::reject_losses(const std::string& action) {
  if (const int number = loss.exchange(no_loss); number != no_loss) throw OutputFault(with_reason(action, number));
}

void Hdf5Handle::forget_losses() { loss = no_loss; }

void check_hdf5(herr_t status, const std::string& action) {
  if (status < 0) throw OutputFault(with_reason(action));
}

std::string file_of(hid_t object) {
  const ssize_t length = H5Fget_name(object, nullptr, 0);
  if (length <= 0) return "";
  std::string name(static_cast<std::size_t>(length), ' ');
  H5Fget_name(object, name.data(), name.size() + 1);
  return name;
}

bool is_hdf5(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;  // a pipe gives its text once, and not for this look
  prepare_hdf5();
  return H5Fis_hdf5(path.c_str()) > 0;
}

Hdf5Handle create_hdf5(const std::string& path) {
  prepare_hdf5();
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "cannot create " + path};
}

Hdf5Handle open_hdf5(const std::string& path) {
  prepare_hdf5();
  try {
    return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "it cannot be opened as HDF5"};
  } catch (const OutputFault& fault) {
    throw ReadFault(path, fault.what());
  }
}

Hdf5Handle open_hdf5_while_written(const std::string& path) {
  prepare_hdf5();
  const std::string action = "it cannot be opened as HDF5";
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, action);
  check_hdf5(H5Pset_file_locking(access, false, true), action);
  check_hdf5(H5Pset_sieve_buf_size(access, 0), action);  // it would keep rows as they were before they were written
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, action};
}

Hdf5Handle reopen_hdf5(const std::string& path) {
  prepare_hdf5();
  return {H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "cannot open " + path};
}

Hdf5Handle create_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          "cannot create group " + name};
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  write_scalar(object, name, text_type(), text.c_str());
}
void write_attribute(hid_t object, const std::string& name, double value) {
  write_scalar(object, name, H5T_NATIVE_DOUBLE, value);
}
void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_scalar(object, name, H5T_NATIVE_INT64, value);
}
void write_attribute(hid_t object, const std::string& name, const std::vector<std::int8_t>& values) {
  const std::string action = writing(object, name);
  const hsize_t size = values.size();
  const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, action);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_INT8, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose, action);
  check_hdf5(H5Awrite(attribute, H5T_NATIVE_INT8, values.data()), action);
}

}  // namespace wormdrive
