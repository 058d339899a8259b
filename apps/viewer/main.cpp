#include "apps/viewer/viewer_options.h"

int main(int argc, char** argv) {
  return penumbra::viewer::run_viewer(argc, argv);
}
