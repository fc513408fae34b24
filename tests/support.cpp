#include "support.hpp"

namespace wormdrive::test {

WORMDRIVE_TEST_RUN(TimedDrive);
WORMDRIVE_TEST_RUN(ArmDrive);

}  // namespace wormdrive::test
