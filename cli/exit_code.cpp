#include "cli/exit_code.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <system_error>

#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"
#include "output/hdf5/hdf5.hpp"

namespace wormdrive {

int guarded(const std::function<int()>& command, const std::string& who) {
  try {
    return command();
  } catch (const InputFault& fault) {
    if (!fault.faults.empty()) std::cerr << fault.what() << '\n';  // else the first rank tells it
    return bad_input;
  } catch (const SimulationFailure& halt) {
    std::cerr << who << ": " << halt.what() << '\n';
    return cannot_go_on;
  } catch (const ReadFault& fault) {
    std::cerr << fault.path << ": error: " << fault.what() << '\n';
    return bad_input;
  } catch (const OutputFault& fault) {
    std::cerr << who << ": " << fault.what() << '\n';
    return cannot_write;
  } catch (const std::system_error& fault) {  // from printing
    std::cerr << who << ": " << fault.what() << '\n';
    return cannot_write;
  } catch (const std::exception& other) {  // out of memory, or something that nobody foresaw
    std::cerr << who << ": cannot go on: " << other.what() << '\n';
    return cannot_go_on;
  }
}

int if_printed(int code) {
  const int reason = std::fflush(stdout) == 0 ? 0 : errno;
  if (reason == 0 && std::ferror(stdout) == 0) return code;
  std::cerr << "wormdrive: cannot write to standard output";
  if (reason != 0) std::cerr << ": " << std::strerror(reason);  // that of an earlier failure is not known any more
  std::cerr << '\n';
  return cannot_write;
}

}  // namespace wormdrive
