#include "support.hpp"

#include "compliant_drives.hpp"

namespace wormdrive::test {

WORMDRIVE_TEST_RUN(TimedDrive);
WORMDRIVE_TEST_RUN(ArmDrive);
WORMDRIVE_TEST_RUN(SumDrive);
WORMDRIVE_TEST_RUN(TimedDriveWithStates);
WORMDRIVE_TEST_RUN(ArmDriveWithStates);
WORMDRIVE_TEST_RUN(SumDriveWithStates);
WORMDRIVE_TEST_RUN(ElasticDrive);

}  // namespace wormdrive::test
