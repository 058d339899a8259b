# Writes the bytes of FONT into OUT, behind penumbra::viewer::font_file().
file(READ ${FONT} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file(WRITE ${OUT} "#include \"apps/viewer/window/font.h\"\n\nnamespace penumbra::viewer {\n\n"
     "std::span<const unsigned char> font_file() {\n"
     "  static constexpr unsigned char kBytes[] = {${bytes}};\n  return kBytes;\n}\n\n}  // namespace penumbra::viewer\n")
