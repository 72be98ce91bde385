# Estran. The commands: make demo | check | test-fast | properties | all | report | stability | bench | deps | clean
# SPDX-License-Identifier: BSD-3-Clause
SHELL = /bin/sh
CC = mpicc
B = build
VERSION = 0.1
COMMIT := $(shell git rev-parse --short HEAD 2>/dev/null || echo unknown)

# ---- what it needs, as Debian 12 packages -------------------------------------------------------------
PACKAGES = build-essential pkg-config libopenmpi-dev openmpi-bin libhdf5-openmpi-dev hdf5-tools \
           libhypre-dev libsundials-dev libconfig-dev libcmocka-dev gnuplot-nox

# ---- how it is built ----------------------------------------------------------------------------------
# No -ffast-math: it gains nothing here and lets NaN pass unseen. -fno-math-errno frees sqrt.
OPT = -O3 -march=native -fno-math-errno -fno-trapping-math -ffp-contract=fast
WARN = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
HDF5_CFLAGS = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags hdf5-openmpi 2>/dev/null))
HDF5_LIBS = $(shell pkg-config --libs hdf5-openmpi 2>/dev/null)
SAN =
CFLAGS = -std=c11 -D_GNU_SOURCE -g $(OPT) $(WARN) $(HDF5_CFLAGS) -isystem /usr/include/hypre $(SAN)
LIBS = $(HDF5_LIBS) -lconfig -lm
FV_LIBS = -lHYPRE -lsundials_kinsol -lsundials_nvecparallel -lsundials_sunlinsolspgmr

objects = $(patsubst %.c,$(B)/o/%.o,$(wildcard $(1)/*.c))
cpl_o = $(addprefix $(B)/o/coupler/,cpl_client.o cpl_data.o cpl_patch.o wire.o alive.o failure.o handshake.o region.o)
mains = $(B)/o/sph/sph.o $(B)/o/fv/fv.o $(B)/o/coupler/coupler.o
sph_o = $(filter-out $(mains),$(call objects,sph)) $(B)/o/coupler/cpl_partner.o
fv_o = $(filter-out $(mains),$(call objects,fv)) $(B)/o/coupler/cpl_partner.o
coupler_o = $(filter-out $(mains) $(cpl_o) $(B)/o/coupler/cpl_%,$(call objects,coupler))

all: $(B)/sph $(B)/fv $(B)/coupler

$(B)/sph: $(B)/o/sph/sph.o $(B)/libsph.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(LIBS)
$(B)/fv: $(B)/o/fv/fv.o $(B)/libfv.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(FV_LIBS) $(LIBS)
$(B)/coupler: $(B)/o/coupler/coupler.o $(B)/libcoupler.a $(B)/libcpl.a $(B)/libcommon.a
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ $(LIBS)
$(B)/libcommon.a: $(call objects,common)
$(B)/libcpl.a: $(cpl_o)
$(B)/libsph.a: $(sph_o)
$(B)/libfv.a: $(fv_o)
$(B)/libcoupler.a: $(coupler_o)
$(B)/lib%.a:
	@rm -f $@; ar rcs $@ $^

$(B)/o/%.o: %.c
	@mkdir -p $(@D)
	@echo "CC $@"
	@$(CC) $(CFLAGS) -MMD -MP -c -o $@ $<
$(B)/o/common/version.o: CFLAGS += -DVERSION='"$(VERSION)"' -DCOMMIT='"$(COMMIT)"'

# ---- tests: every tests/test_X.c is a program; tests/mock.c knows cpl.h alone -------------------------
tests_bin = $(patsubst tests/%.c,$(B)/tests/%,$(wildcard tests/test_*.c tests/bench_*.c tests/toy*.c))
$(B)/tests/mock: $(B)/o/tests/mock.o $(B)/libcpl.a
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $^ -lm
$(B)/tests/%: $(B)/o/tests/%.o $(B)/libsph.a $(B)/libfv.a $(B)/libcoupler.a $(B)/libcpl.a $(B)/libcommon.a
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(SAN) -o $@ $< -Wl,--start-group $(filter %.a,$^) -Wl,--end-group $(FV_LIBS) $(LIBS) -lcmocka
$(B)/tests/kill_at.so: tests/kill_at.c
	@mkdir -p $(@D)
	@echo "LD $@"
	@$(CC) $(filter-out -MMD,$(CFLAGS)) -shared -fPIC -o $@ $< -ldl
$(B)/tests/properties_scene: $(patsubst %.c,$(B)/o/%.o,$(wildcard tests/properties_*.c)) # knows no other code
	@mkdir -p $(@D)
	@echo "LD $@"
	@cc $(SAN) -o $@ $^ -lm
tests: all $(tests_bin) $(B)/tests/mock $(B)/tests/kill_at.so $(B)/tests/properties_scene
asan:
	@$(MAKE) --no-print-directory B=$(B)/asan OPT="-O1 -march=native -fno-math-errno" \
	    SAN="-fsanitize=address,undefined -fno-omit-frame-pointer" tests

# ---- what a user types ---------------------------------------------------------------------------------
deps:
	@cases/deps $(PACKAGES)
demo: deps
	@$(MAKE) --no-print-directory -j2 all
	@cases/demo
check: deps
	@$(MAKE) --no-print-directory -j2 tests
	@$(MAKE) --no-print-directory -j2 asan
	@tests/run $(B)
test-fast: # units alone, for development
	@$(MAKE) --no-print-directory -j2 tests
	@FAST=1 tests/run $(B)
properties: all $(B)/tests/properties_scene # SEED=, N= or MINUTES=, JOBS=, KEEP=
	@tests/properties $(B)
report: all
	@cases/report
stability: all
	@cases/stability
bench: tests
	@cases/bench $(B)
clean:
	rm -rf build

-include $(shell find $(B) -name '*.d' 2>/dev/null)
.SECONDARY:
.PHONY: all tests asan deps demo check test-fast properties report stability bench clean
