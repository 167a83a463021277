/// Pictures that tests ask for.
#pragma once

#include "vorpipe.h"

namespace vorpipe::test {

inline RenderOptions pictureOf(const Box& domain, int width = 96, int height = 96) {
  RenderOptions options{};
  options.domain = domain;
  options.width = width;
  options.height = height;
  return options;
}

}  // namespace vorpipe::test
