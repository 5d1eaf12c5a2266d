#!/bin/sh
# By this a kit of the classic or the any-angle track compiles its harness with our entry.
set -eu
mkdir -p index_data
${CXX:-g++} -std=c++17 -O3 -DNDEBUG -I . -o run ./*.cpp libmediant.a -lpthread -ldl -lm
