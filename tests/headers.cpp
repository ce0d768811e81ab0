// Nothing: this file is there for the headers that are compiled before it (tests/tests.cmake).
