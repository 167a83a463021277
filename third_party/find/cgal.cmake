# Headers alone, with GMP and MPFR; not by its CMake package, which changes the build type and the flags.
find_path(CGAL_INCLUDE_DIR CGAL/Exact_predicates_exact_constructions_kernel.h)
find_path(BOOST_INCLUDE_DIR boost/multiprecision/gmp.hpp)
find_library(GMP_LIBRARY gmp)
find_library(MPFR_LIBRARY mpfr)
if(CGAL_INCLUDE_DIR AND BOOST_INCLUDE_DIR AND GMP_LIBRARY AND MPFR_LIBRARY)
  add_library(dep::cgal INTERFACE IMPORTED)
  target_include_directories(dep::cgal SYSTEM INTERFACE ${CGAL_INCLUDE_DIR} ${BOOST_INCLUDE_DIR})
  # Interval arithmetic needs the rounding that it sets.
  target_compile_options(dep::cgal INTERFACE $<$<CXX_COMPILER_ID:GNU>:-frounding-math>)
  target_link_libraries(dep::cgal INTERFACE ${MPFR_LIBRARY} ${GMP_LIBRARY})
endif()
