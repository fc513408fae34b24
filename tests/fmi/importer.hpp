#pragma once
// An importer of FMUs that does what FMI 2.0.4, section 3.2 asks of one, and nothing that it knows of wormdrive.
#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <dlfcn.h>

#include "bindings/fmi/fmi2.h"
#include "cli/program.hpp"

namespace wormdrive::test {

/// An FMU unpacked into a folder, its description read and its library loaded: its own, or the one that the environment
/// names, which a memory checker watches.
class Fmu {
 public:
  Fmu(const std::string& file, const Folder& folder) : resources_("file://" + (folder / "resources")) {
    unpack(file, folder);
    boost::property_tree::ptree xml;
    read_xml(folder / "modelDescription.xml", xml);
    const auto& model = xml.get_child("fmiModelDescription");
    const bool second = model.get<std::string>("<xmlattr>.fmiVersion") == "2.0";
    guid_ = model.get<std::string>(second ? "<xmlattr>.guid" : "<xmlattr>.instantiationToken");
    indicators = model.get<size_t>("<xmlattr>.numberOfEventIndicators", 0);
    for (const auto& [tag, variable] : model.get_child("ModelVariables"))
      references_[variable.get<std::string>("<xmlattr>.name")] = variable.get<unsigned>("<xmlattr>.valueReference");
    if (second) states = model.get_child("ModelStructure.Derivatives").count("Unknown");
    const char* const type = model.count("CoSimulation") > 0 ? "CoSimulation" : "ModelExchange";
    const auto name = model.get<std::string>(std::string(type) + ".<xmlattr>.modelIdentifier");
    const char* const watched = std::getenv("WORMDRIVE_FMU_LIBRARY");
    library_ = dlopen(
        watched ? watched
                : (folder / ("binaries/" + std::string(second ? "linux64/" : "x86_64-linux/") + name + ".so")).c_str(),
        RTLD_NOW | RTLD_LOCAL);
    if (!library_) throw std::runtime_error(dlerror());
  }
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;
  ~Fmu() { dlclose(library_); }

  size_t states = 0, indicators = 0;
  const std::string& guid() const { return guid_; }
  const std::string& resources() const { return resources_; }
  unsigned reference(const std::string& name) const { return references_.at(name); }
  const std::map<std::string, unsigned>& references() const { return references_; }
  void* symbol(const char* name) const { return dlsym(library_, name); }

 private:
  static void unpack(const std::string& file, const Folder& folder) {
    archive* const zip = archive_read_new();
    archive_read_support_format_zip(zip);
    if (archive_read_open_filename(zip, file.c_str(), 65536) != ARCHIVE_OK) throw std::runtime_error("no zip: " + file);
    archive_entry* entry;
    while (archive_read_next_header(zip, &entry) == ARCHIVE_OK) {
      const std::filesystem::path path = folder.path() / archive_entry_pathname(entry);
      std::filesystem::create_directories(path.parent_path());
      std::ofstream out(path, std::ios::binary);
      std::vector<char> buffer(65536);
      for (la_ssize_t n; (n = archive_read_data(zip, buffer.data(), buffer.size())) > 0;) out.write(buffer.data(), n);
    }
    archive_read_free(zip);
  }

  std::string guid_, resources_;
  std::map<std::string, unsigned> references_;
  void* library_;
};

/// One instance of an FMU; a call that does not return fmi2OK throws what the FMU logged.
class Instance {
 public:
  explicit Instance(const Fmu& fmu, const std::string& guid = "", fmi2Type type = fmi2ModelExchange) : fmu_(fmu) {
    component_ = function<decltype(fmi2Instantiate)>("fmi2Instantiate")(
        "drive", type, guid.empty() ? fmu.guid().c_str() : guid.c_str(), fmu.resources().c_str(), &callbacks_, 0, 0);
    if (!component_) throw std::runtime_error(log_);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() { function<decltype(fmi2FreeInstance)>("fmi2FreeInstance")(component_); }

  template <class Function, class... Arguments>
  void call(const char* name, Arguments... arguments) {
    log_.clear();
    if (status<Function>(name, arguments...) != fmi2OK) throw std::runtime_error(log_);
  }
  template <class Function, class... Arguments>
  fmi2Status status(const char* name, Arguments... arguments) {
    return function<Function>(name)(component_, arguments...);
  }
  const std::string& log() const { return log_; }
  double real(const std::string& name) {
    const unsigned reference = fmu_.reference(name);
    double value;
    call<decltype(fmi2GetReal)>("fmi2GetReal", &reference, size_t{1}, &value);
    return value;
  }
  int integer(const std::string& name) {
    const unsigned reference = fmu_.reference(name);
    int value;
    call<decltype(fmi2GetInteger)>("fmi2GetInteger", &reference, size_t{1}, &value);
    return value;
  }
  void set(const std::string& name, double value) {
    const unsigned reference = fmu_.reference(name);
    call<decltype(fmi2SetReal)>("fmi2SetReal", &reference, size_t{1}, &value);
  }
  const Fmu& fmu() const { return fmu_; }

 private:
  template <class Function>
  Function* function(const char* name) const {
    if (void* const found = fmu_.symbol(name)) return reinterpret_cast<Function*>(found);
    throw std::runtime_error(std::string("no function ") + name);
  }
  static void logger(fmi2ComponentEnvironment self, fmi2String, fmi2Status, fmi2String, fmi2String format, ...) {
    va_list arguments;
    va_start(arguments, format);
    std::vector<char> text(4096);
    vsnprintf(text.data(), text.size(), format, arguments);
    va_end(arguments);
    static_cast<Instance*>(self)->log_ = text.data();
  }

  const Fmu& fmu_;
  std::string log_;
  fmi2CallbackFunctions callbacks_{logger, calloc, free, nullptr, this};
  fmi2Component component_;
};

}  // namespace wormdrive::test
