#include "bindings/fmi/export_fmu.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "bindings/fmi/model_description.hpp"
#include "bindings/fmi/plant_json.hpp"
#include "bindings/fmi/plant_parameters.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/resource.hpp"

namespace wormdrive {
namespace {

/// A zip archive that disappears unless it is finished.
class Zip {
 public:
  explicit Zip(std::string path)
      : path_(std::move(path)), part_(path_ + ".part"), archive_(archive_write_new(), archive_write_free) {
    if (!archive_) throw std::bad_alloc();
    check(archive_write_set_format_zip(archive_.get()));
    check(archive_write_open_filename(archive_.get(), part_.c_str()));
  }
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;
  ~Zip() {
    archive_.reset();
    if (std::error_code none; !finished_) std::filesystem::remove(part_, none);
  }

  void add(const std::string& name, const std::string& content) {
    const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), archive_entry_free);
    if (!entry) throw std::bad_alloc();
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    check(archive_write_header(archive_.get(), entry.get()));
    if (archive_write_data(archive_.get(), content.data(), content.size()) < 0) fail();
  }
  void finish() {
    check(archive_write_close(archive_.get()));
    std::error_code error;
    std::filesystem::rename(part_, path_, error);
    if (error) throw OutputFault(fmt::format("cannot rename {} to {}: {}", part_, path_, error.message()));
    finished_ = true;
  }

 private:
  void check(int status) {
    if (status < ARCHIVE_WARN) fail();
  }
  [[noreturn]] void fail() {
    const int number = archive_errno(archive_.get());
    const char* const text = archive_error_string(archive_.get());
    throw OutputFault(fmt::format("cannot write {}: {}", part_,
                                  number > 0 ? std::strerror(number)
                                  : text     ? text
                                             : "unknown reason"));
  }

  std::string path_, part_;
  std::unique_ptr<archive, decltype(&archive_write_free)> archive_;
  bool finished_ = false;
};

/// The library of the model, as the build made it.
std::string read_library() {
  const std::string path = resource("lib/wormdrive/fmi/wormdrive_fmu.so");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw OutputFault(fmt::format("cannot make an FMU: cannot read {}", path));
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The name of the first file in an archive of this program, by which it is known.
constexpr std::string_view archive_mark = "documentation/wormdrive.txt";

/// As the standard calls the platform [FMI 2.0.4, section 2.3].
constexpr std::string_view platform = sizeof(void*) == 8 ? "linux64" : "linux32";

}  // namespace

std::optional<std::string> not_exportable(const Scenario& scenario) {
  const Effects<double>& on = scenario.effects;
  if (const auto id = on.first_with_states(); !id.empty())
    return fmt::format("effect.{} has a state, which the FMU does not carry; set effect.{}.inductance_H = 0", id, id);
  const char* what = on.delay() > 0.0             ? "actuator_delay"
                     : on.lag() > 0.0             ? "actuator_lag"
                     : on.measuring_delay() > 0.0 ? "encoder_delay"
                                                  : nullptr;
  if (!what) return std::nullopt;
  return fmt::format(
      "effect.{} needs a memory of the past, which an FMU for model exchange does not have; switch it "
      "off (effect.{}.on = false) and add the delay or lag outside the FMU in the importing tool",
      what, what);
}

void export_fmu(const Scenario& scenario, const std::string& path, Replace replace) {
  const std::string plant = plant_to_json(scenario), library = read_library(), file = followed(path);
  reject_replacing_unmarked(file, archive_mark, replace);
  Zip zip(file);
  zip.add(std::string(archive_mark), "An FMU of a worm-gear drive, made by wormdrive.\n");
  zip.add("modelDescription.xml", model_description(scenario, guid_of(plant)));
  zip.add("resources/plant.json", plant);
  zip.add(fmt::format("binaries/{}/{}.so", platform, model_identifier), library);
  zip.finish();
}

}  // namespace wormdrive
