// Making an instance: where an FMU's resources are, and whether they are those of the description.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "bindings/fmi/component.hpp"
#include "bindings/fmi/json/plant_json.hpp"

namespace wormdrive {
namespace {

int digit(char c) {
  const std::string_view digits = "0123456789abcdef";
  const auto at = digits.find(static_cast<char>(c | 0x20));
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// The path of a URI "file:///a%20b", "file:/a" (with a drive of Windows "file:///C:/a"), or of a plain path.
std::string path_of(std::string_view uri) {
  bool is_uri = false;
  for (const std::string_view scheme : {"file://localhost/", "file:///", "file:/"})
    if (uri.starts_with(scheme)) {
      uri.remove_prefix(scheme.size() - 1);
      is_uri = true;
      break;
    }
  if (!is_uri) return std::string(uri);
  if (uri.size() > 2 && uri[2] == ':') uri.remove_prefix(1);
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    if (uri[k] == '%' && k + 2 < uri.size() && digit(uri[k + 1]) >= 0 && digit(uri[k + 2]) >= 0) {
      path += static_cast<char>(16 * digit(uri[k + 1]) + digit(uri[k + 2]));
      k += 2;
    } else {
      path += uri[k];
    }
  }
  return path;
}

FmuModel read_model(std::string_view resources, std::string_view token) {
  std::string path = path_of(resources);
  if (!path.ends_with('/') && !path.ends_with('\\')) path += '/';
  path += "plant.json";
  std::ifstream file(std::filesystem::path(std::u8string(path.begin(), path.end())), std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (guid_of(text) != token) throw std::runtime_error("the GUID " + std::string(token) + " is not that of " + path);
  FmuModel model = plant_from_json(text);
  model.token = token;
  return model;
}

}  // namespace

FmuInstance make_instance(const char* name, const char* token, const char* resources, InterfaceType type) {
  if (!name || std::string_view(name).find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw std::invalid_argument("the name of the instance is missing");
  if (!token || !resources) throw std::invalid_argument("GUID or location of the resources is missing");
  return {read_model(resources, token), type};
}

}  // namespace wormdrive
