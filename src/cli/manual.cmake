# Man pages and completions, written by the program that was just built. Where it cannot run, since it is built for
# another machine, there are none. Others may write and install them by the same two options.
if(CMAKE_CROSSCOMPILING)
  return()
endif()
set(vorpipe_manual_dir ${CMAKE_BINARY_DIR}/manual)
set(vorpipe_pages ${vorpipe_manual_dir}/vorpipe.1)
set(vorpipe_page_commands COMMAND vorpipe --help-man > ${vorpipe_manual_dir}/vorpipe.1)
# Each subcommand has a file of its name.
file(GLOB vorpipe_commands CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/commands/*.cpp)
list(FILTER vorpipe_commands EXCLUDE REGEX "/main\\.cpp$")
foreach(file IN LISTS vorpipe_commands)
  cmake_path(GET file STEM subcommand)
  list(APPEND vorpipe_pages ${vorpipe_manual_dir}/vorpipe-${subcommand}.1)
  list(APPEND vorpipe_page_commands COMMAND vorpipe --help-man ${subcommand} >
       ${vorpipe_manual_dir}/vorpipe-${subcommand}.1)
endforeach()
file(MAKE_DIRECTORY ${vorpipe_manual_dir})
add_custom_command(
  OUTPUT ${vorpipe_pages} ${vorpipe_manual_dir}/vorpipe ${vorpipe_manual_dir}/_vorpipe
         ${vorpipe_manual_dir}/vorpipe.fish ${vorpipe_page_commands}
  COMMAND vorpipe --completions bash > ${vorpipe_manual_dir}/vorpipe
  COMMAND vorpipe --completions zsh > ${vorpipe_manual_dir}/_vorpipe
  COMMAND vorpipe --completions fish > ${vorpipe_manual_dir}/vorpipe.fish
  DEPENDS vorpipe
  COMMENT "Man pages and completions"
  VERBATIM)
add_custom_target(vorpipe_manuals ALL DEPENDS ${vorpipe_pages} ${vorpipe_manual_dir}/vorpipe)

if(VORPIPE_INSTALL)
  include(GNUInstallDirs)
  install(FILES ${vorpipe_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  set(vorpipe_share ${CMAKE_INSTALL_DATADIR})
  install(FILES ${vorpipe_manual_dir}/vorpipe DESTINATION ${vorpipe_share}/bash-completion/completions
          COMPONENT program)
  install(FILES ${vorpipe_manual_dir}/_vorpipe DESTINATION ${vorpipe_share}/zsh/site-functions COMPONENT program)
  install(FILES ${vorpipe_manual_dir}/vorpipe.fish DESTINATION ${vorpipe_share}/fish/vendor_completions.d
          COMPONENT program)
endif()
