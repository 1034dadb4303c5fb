# SPDX-License-Identifier: MIT
# The whole build, one file. `make help` lists the targets.
-include config.mk

BUILD    ?= build
CROSS    ?=
CC       := $(CROSS)$(if $(filter default,$(origin CC)),gcc,$(CC))
AR       := $(CROSS)ar
PKG_CONFIG ?= pkg-config
prefix   ?= /usr/local
WERROR   ?= -Werror
CFLAGS   ?= -O2 -g
CPPFLAGS += -I. -Iruntime -D_POSIX_C_SOURCE=200809L
WARN     := -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes \
            -Wswitch-enum -Wvla $(WERROR)
# Frames under 1 KB in what runs on a board (STYLE: an 8 KB stack).
FRAME    := $(if $(findstring sanitize,$(CFLAGS)),,-Wframe-larger-than=1024)

obj  = $(patsubst %.c,$(BUILD)/%.o,$(1))
ENGINE   := $(wildcard runtime/engine/*.c runtime/engine/*/*.c)
SMALL    := $(wildcard runtime/engine/base/*.c runtime/engine/scan/*.c)

all: $(BUILD)/libladder.a ## build everything that can be built here

$(BUILD)/libladder.a: $(call obj,$(ENGINE))
	@rm -f $@
	$(AR) rcs $@ $^

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) -std=c11 $(CPPFLAGS) $(WARN) $(CFLAGS) -MMD -MP -c -o $@ $<
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)

UNIT := $(patsubst tests/unit/%.c,$(BUILD)/unit/%,$(wildcard tests/unit/test_*.c))
$(BUILD)/unit/%: $(BUILD)/tests/unit/%.o $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
unit: $(UNIT) ## build and run the unit tests
	prove -e '' $(UNIT)

words: $(BUILD)/unit/test_words ## write docs/words.md anew from the catalogue
	$< --print > docs/words.md

clean: ## remove everything that was built
	rm -rf $(BUILD)
help: ## list the targets
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "  %-14s %s\n", $$1, $$2}' Makefile
.PHONY: all unit words clean help
