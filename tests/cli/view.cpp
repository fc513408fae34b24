// One malformed input per line:
// clang-format off
#include <netinet/in.h>
#include <sys/socket.h>

#include "cli/bad_input.hpp"

// What `wormdrive view` says about sliders that cannot be, and about a port that is taken. tests/view/live_page.py asks
// the page itself.

namespace wormdrive::test::cli_view {

namespace {

BadInput vary(const std::string& name, const std::string& wanted, const std::string& message) {
  return {name, good_scenario, "--vary " + wanted + ": error: " + message, {"view", "s.toml", "--vary", wanted}, true};
}

/// A port of the loopback address that stays taken.
struct TakenPort {
  int handle = socket(AF_INET, SOCK_STREAM, 0);
  int number = 0;

  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(handle, any, size) != 0 || ::listen(handle, 1) != 0 || getsockname(handle, any, &size) != 0)
      throw std::runtime_error("no port");
    number = ntohs(address.sin_port);
  }
  ~TakenPort() { ::close(handle); }
};

}  // namespace

TEST_CASE("a slider that cannot be is refused with the key, the reason and the cure") {
  check_rejected(Folder(), {
      vary("unknown", "mesh.ratoi", "the scenario has no number 'mesh.ratoi'; did you mean 'mesh.ratio'?"),
      vary("far off", "xyz", "the scenario has no number 'xyz'; wormdrive check lists its numbers"),
      vary("no range", "mesh.ratio=5", "'5' is no range; it reads low..high"),
      vary("wrong way", "mesh.ratio=60..50", "'60..50' is no range; it reads low..high"),
      vary("no number", "mesh.ratio=a..b", "'a..b' is no range; it reads low..high"),
      vary("empty", "mesh.ratio=..", "'..' is no range; it reads low..high"),
      vary("zero", "initial.gear_angle_rad", "'initial.gear_angle_rad' is 0, which gives no range; state one: initial.gear_angle_rad=low..high")});
}

TEST_CASE("a port that is taken is named") {
  const TakenPort taken;
  const std::string port = std::to_string(taken.number);
  check_rejected(Folder(), {{"taken", good_scenario,
      "--port " + port + ": error: another program has it; 0 takes any that is free", {"view", "s.toml", "--port", port}, true}});
}

}  // namespace wormdrive::test::cli_view
