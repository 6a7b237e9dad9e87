message(STATUS "layers")
