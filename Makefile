# Estran: make demo | check | all | report | stability | bench | deps | clean
SHELL = /bin/sh
CC = mpicc
B = build
VERSION = 0.1
COMMIT := $(shell git rev-parse --short HEAD 2>/dev/null || echo unknown)
HDF5_CFLAGS = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags hdf5-openmpi 2>/dev/null))
HDF5_LIBS = $(shell pkg-config --libs hdf5-openmpi 2>/dev/null)
OPT = -O3 -march=native -fno-math-errno -fno-trapping-math -ffp-contract=fast
WARN = -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
CFLAGS = -std=c11 -D_GNU_SOURCE -g $(OPT) $(WARN) -Wno-psabi $(HDF5_CFLAGS) -isystem /usr/include/hypre
SAN =
HYPRE_LIBS = -lHYPRE

common_o = $(patsubst %.c,$(B)/%.o,$(wildcard common/*.c))
cpl_o = $(B)/coupler/cpl_client.o $(B)/coupler/cpl_patch.o $(B)/coupler/wire.o $(B)/coupler/failure.o
sph_o = $(patsubst %.c,$(B)/%.o,$(wildcard sph/*.c))
fv_o = $(patsubst %.c,$(B)/%.o,$(wildcard fv/*.c))
coupler_o = $(filter-out $(B)/coupler/cpl_%.o,$(patsubst %.c,$(B)/%.o,$(wildcard coupler/*.c)))

all: $(B)/sph $(B)/fv $(B)/coupler

$(B)/sph: $(sph_o) $(B)/coupler/cpl_partner.o $(B)/libcpl.a $(B)/libcommon.a
	$(CC) $(SAN) -o $@ $^ $(HDF5_LIBS) -lconfig -lm
$(B)/fv: $(fv_o) $(B)/coupler/cpl_partner.o $(B)/libcpl.a $(B)/libcommon.a
	$(CC) $(SAN) -o $@ $^ $(HYPRE_LIBS) $(HDF5_LIBS) -lconfig -lm
$(B)/coupler: $(coupler_o) $(B)/libcommon.a
	$(CC) $(SAN) -o $@ $^ $(HDF5_LIBS) -lconfig -lm
$(B)/libcommon.a: $(common_o)
	@rm -f $@; ar rcs $@ $^
$(B)/libcpl.a: $(cpl_o)
	@rm -f $@; ar rcs $@ $^

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(SAN) -MMD -MP -c -o $@ $<

clean:
	rm -rf $(B)

-include $(shell find $(B) -name '*.d' 2>/dev/null)
.PHONY: all demo check report stability bench deps clean
