# The headers alone.
find_path(EIGEN_INCLUDE_DIR Eigen/SparseCholesky PATH_SUFFIXES eigen3)
if(EIGEN_INCLUDE_DIR)
  add_library(dep::eigen INTERFACE IMPORTED)
  target_include_directories(dep::eigen SYSTEM INTERFACE ${EIGEN_INCLUDE_DIR})
  # Without what of it has another license than MPL-2.0.
  target_compile_definitions(dep::eigen INTERFACE EIGEN_MPL2_ONLY)
endif()
