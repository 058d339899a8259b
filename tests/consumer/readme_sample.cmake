# Fails unless README holds SAMPLE word for word.
file(READ ${README} readme)
file(READ ${SAMPLE} sample)
string(FIND "${readme}" "${sample}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "The C++ sample in README.md differs from ${SAMPLE}; copy the file into the README.")
endif()
