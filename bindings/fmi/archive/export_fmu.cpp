#include "bindings/fmi/archive/export_fmu.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include "bindings/fmi/archive/model_description.hpp"
#include "bindings/fmi/json/plant_json.hpp"
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

/// The library of the model for a platform, and its name in the archive.
struct Binary {
  std::string name, content;
};

/// The library of the model as the build made it, if it did.
std::optional<std::string> read_library(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// As the standards call platforms [FMI 2.0.4, section 2.3; 3.0, section 2.5.1.4.2].
struct Platform {
  std::string_view fmi2, fmi3, suffix;
};
#if defined(__aarch64__)
constexpr Platform own_platform{"linux64", "aarch64-linux", "so"};
#else
constexpr Platform own_platform{sizeof(void*) == 8 ? "linux64" : "linux32",
                                sizeof(void*) == 8 ? "x86_64-linux" : "x86-linux", "so"};
#endif
constexpr Platform windows{"win64", "x86_64-windows", "dll"};

std::vector<Binary> read_binaries(int version, bool for_windows) {
  std::vector<Binary> found;
  std::filesystem::path path = resource("lib/wormdrive/fmi/wormdrive_fmu.so");
  for (const Platform& platform : {own_platform, windows}) {
    if (platform.suffix == windows.suffix && !for_windows) continue;
    path.replace_extension(platform.suffix);
    std::optional<std::string> content = read_library(path);
    if (!content && found.empty()) throw OutputFault(fmt::format("cannot make an FMU: cannot read {}", path.string()));
    if (!content) continue;  // not every build has the one for Windows
    const std::string_view folder = version == 2 ? platform.fmi2 : platform.fmi3;
    found.push_back({fmt::format("binaries/{}/{}.{}", folder, model_identifier, platform.suffix), *content});
  }
  return found;
}

/// The name of the first file in an archive of this program, by which it is known.
constexpr std::string_view archive_mark = "documentation/wormdrive.txt";

}  // namespace

std::optional<std::string> not_exportable(const FmuModel& model) {
  const Effects<double>& on = model.scenario.effects;
  const bool elastic = has_elastic_teeth(on) && !elastic_teeth_inside, plant = model.kind == FmuKind::plant;
  if (elastic && !plant)
    return "effect.tooth_compliance needs CVODE, which an FMU does not carry; use --kind plant, whose importing tool "
           "integrates";
  const auto needs_memory = [](std::string_view id, std::string_view cure) {
    return fmt::format("effect.{} needs a memory of the past, {} (effect.{}.on = false)", id, cure, id);
  };
  if (plant && on.measuring_delay() > 0.0)
    return needs_memory("encoder_delay", "which only samples of a controller have: use --kind loop, or switch it off");
  if (elastic && (on.delay() > 0.0 || on.lag() > 0.0))
    return needs_memory(on.delay() > 0.0 ? "actuator_delay" : "actuator_lag",
                        "which the importing tool's solver, needed by elastic teeth, does not have; switch it off");
  return std::nullopt;
}

void export_fmu(const FmuModel& stated, int version, const std::string& path, Replace replace) {
  const std::string json = plant_to_json(stated), file = followed(path);
  FmuModel model = stated;
  model.token = guid_of(json);
  const std::vector<Binary> binaries = read_binaries(version, runs_under_windows(model));
  reject_replacing_unmarked(file, archive_mark, replace);
  Zip zip(file);
  zip.add(std::string(archive_mark), "An FMU of a worm-gear drive, made by wormdrive.\n");
  zip.add("modelDescription.xml", version == 2 ? fmi2_description(model) : fmi3_description(model));
  if (version == 3) zip.add("terminalsAndIcons/terminalsAndIcons.xml", fmi3_terminals(model));
  zip.add("resources/plant.json", json);
  for (const Binary& binary : binaries) zip.add(binary.name, binary.content);
  zip.finish();
}

}  // namespace wormdrive
