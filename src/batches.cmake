# VORPIPE_BATCHES: sources that lie together are compiled as one, because most of what each takes is headers and
# templates that all of them have. The preset dev does so, for a build from nothing; who edits one source again and
# again says -D VORPIPE_BATCHES=OFF. In the presets release, bench and asan each source stands alone, and must name all
# that it uses, which the test named_headers holds it to.
option(VORPIPE_BATCHES "Compile sources that lie together as one" OFF)
if(VORPIPE_BATCHES)
  # GCC collects its garbage at each doubling of 128 MB. A batch needs 1.2 GB without that, 1 GB with it, and a tenth
  # more time.
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=2097152>)
endif()

# vorpipe_batches(target [ALONE name...]): its sources in batches of whole folders, as many as it takes to have a dozen
# sources. ALONE are files with private names that others of the batch have as well, of which the
# compiler says "redefinition" or "shadows"; before a name that files of other folders have too stands its folder, as in
# sites/weights.cpp.
function(vorpipe_batches target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ALONE")
  if(NOT VORPIPE_BATCHES)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(count 0)
  foreach(source IN LISTS sources)
    cmake_path(GET source FILENAME name)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME last)
    if(name IN_LIST arg_ALONE OR "${last}/${name}" IN_LIST arg_ALONE)
      continue()
    endif()
    string(REPLACE "${CMAKE_CURRENT_SOURCE_DIR}/" "" folder "${folder}")
    if(count EQUAL 0 OR (count GREATER_EQUAL 12 AND NOT folder STREQUAL folder_before))
      string(MAKE_C_IDENTIFIER "batch_${folder}" group)
      set(count 0)
    endif()
    set(folder_before "${folder}")
    math(EXPR count "${count} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Rooms whose sources are compiled so, but for those that are alone.
set(vorpipe_alone
    cells_vtk.cpp
    delaunay/hilbert_order.cpp
    delaunay/mesh_cells.cpp
    delaunay/triangulation.cpp
    diagram/dual_triangles.cpp
    discs/far_disc.cpp
    edges.cpp
    fish.cpp
    legend.cpp
    measured/plot.cpp
    moving/box_moments.cpp
    moving/disc_cells.cpp
    moving/polygon_edges.cpp
    nearest_site.cpp
    outline.cpp
    outline/clip_cell.cpp
    outline/clipped_records.cpp
    outline/own_parts.cpp
    outline/validity.cpp
    panel/panel.cpp
    periodic/band.cpp
    periodic/band_proof.cpp
    periodic/unwrap.cpp
    picture_files.cpp
    pipelines/cells.cpp
    pipelines/geometry.cpp
    png_file.cpp
    polygon_drawing.cpp
    search/bisectors.cpp
    search/flann_search.cpp
    sites/near_sites.cpp
    sites/site_set.cpp
    sites/weights.cpp
    stages.cpp
    stats.cpp
    svg_picture.cpp
    thesis.cpp
    ties/collapsed_edges.cpp
    ties/tied_records.cpp
    ties/tied_vertices.cpp
    ties/wide_vertices.cpp
    uncovered.cpp
    window/vulkan_presenter.cpp
    zsh.cpp)
set(vorpipe_batched_rooms
    vorpipe_bench_lab
    vorpipe_bench_measured
    vorpipe_bench_tables
    vorpipe_cells
    vorpipe_check
    vorpipe_cli_manual
    vorpipe_cli_moving
    vorpipe_cli_options
    vorpipe_cli_reports
    vorpipe_cli_runs
    vorpipe_cli_terminal
    vorpipe_colors
    vorpipe_compare
    vorpipe_delaunay
    vorpipe_diagram
    vorpipe_discs
    vorpipe_drawing
    vorpipe_forecast
    vorpipe_geometry
    vorpipe_io_arrays
    vorpipe_io_cells
    vorpipe_io_columns
    vorpipe_io_domain
    vorpipe_io_edges
    vorpipe_io_files
    vorpipe_io_fluid
    vorpipe_io_geopackage
    vorpipe_io_meshes
    vorpipe_io_pictures
    vorpipe_io_points
    vorpipe_io_text
    vorpipe_io_weights
    vorpipe_marks
    vorpipe_moved_fluid
    vorpipe_moved_linear
    vorpipe_moved_relax
    vorpipe_moved_transport
    vorpipe_moving
    vorpipe_opengl_device
    vorpipe_opengl_memory
    vorpipe_opengl_pipelines
    vorpipe_outline
    vorpipe_periodic
    vorpipe_picture
    vorpipe_search
    vorpipe_session
    vorpipe_sites
    vorpipe_ties
    vorpipe_tiles
    vorpipe_topology
    vorpipe_vertices
    vorpipe_view_app
    vorpipe_view_document
    vorpipe_view_events
    vorpipe_view_frames
    vorpipe_view_panel
    vorpipe_view_recording
    vorpipe_view_window
    vorpipe_vulkan_device
    vorpipe_vulkan_geometry
    vorpipe_vulkan_kernels
    vorpipe_vulkan_memory)
