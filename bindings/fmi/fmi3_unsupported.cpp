// What FMI 3.0 has beside and this FMU does not offer: importers load every function, also those they never call.
#include "bindings/fmi/component.hpp"
#include "bindings/fmi/fmi3.h"

using namespace wormdrive;

namespace {

fmi3Status refused(fmi3Instance c, const char* function) { return static_cast<fmi3Status>(unsupported(c, function)); }
/// There are no variables of this type.
fmi3Status none(fmi3Instance c, const char* function, size_t count) {
  return static_cast<fmi3Status>(no_variables(c, function, count));
}

}  // namespace

fmi3Status fmi3GetFloat32(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Float32[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Float32[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int8[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int8[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt8[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt8[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int16[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int16[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetUInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt16[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetUInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt16[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetUInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt32[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetUInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt32[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int64[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int64[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt64[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt64[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Boolean[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Boolean[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3String[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3String[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference[], size_t count, size_t[], fmi3Binary[], size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference[], size_t count, const size_t[], const fmi3Binary[],
                         size_t) {
  return none(c, __func__, count);
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[],
                                   fmi3IntervalQualifier[]) {
  return refused(c, __func__);
}
fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[]) {
  return refused(c, __func__);
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3Float64[]) {
  return refused(c, __func__);
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                   const fmi3UInt64[]) {
  return refused(c, __func__);
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3Float64[]) {
  return refused(c, __func__);
}
fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                const fmi3UInt64[]) {
  return refused(c, __func__);
}
fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) { return refused(c, __func__); }
fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) { return refused(c, __func__); }
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) { return refused(c, __func__); }
fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference, fmi3Float64) { return refused(c, __func__); }
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t*) {
  return refused(c, __func__);
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
                                       fmi3DependencyKind[], size_t) {
  return refused(c, __func__);
}
