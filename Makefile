# SPDX-License-Identifier: MIT
# The whole build, one file. `make help` lists the targets.
-include config.mk

CROSS    ?=
SMALL    ?=
# SMALL=1 LINK=serial: with `ladderd --serial`, for the services that need no names.
LINK     ?=
$(if $(filter-out serial,$(LINK))$(if $(LINK),$(if $(filter 1,$(SMALL)),,x)),$(error LINK=$(LINK): it is serial, with SMALL=1))
WORDS    ?= all
BUILD    ?= build$(CROSS:%-=/%)$(SMALL:1=/small)
CC       := $(CROSS)$(if $(filter default,$(origin CC)),gcc,$(CC))
AR       := $(CROSS)ar
PKG_CONFIG ?= pkg-config
prefix   ?= /usr/local
WERROR   ?= -Werror
CFLAGS   ?= $(if $(filter 1,$(SMALL)),-Os,-O2) -g
# time_t has 64 bits also on 32-bit boards, for dates after 2038.
CPPFLAGS += -I. -Iruntime -D_POSIX_C_SOURCE=200809L -D_FILE_OFFSET_BITS=64 -D_TIME_BITS=64 $(SMALL:1=-DRUNGBOARD_SMALL) $(LINK:serial=-DRUNGBOARD_SERIAL) $(if $(CROSS),$(STATIC:1=-DRUNGBOARD_WHOLE)) $(if $(filter core,$(WORDS)),-DRUNGBOARD_CORE_WORDS)
# No fused multiply-add, or REAL would differ from board to board.
STD      := -std=c11 -ffp-contract=off
LDFLAGS  += $(STATIC:1=-static)
WARN     := -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes \
            -Wswitch-enum -Wvla $(WERROR)
# Frames under 1 KB in what runs on a board: it may have a stack of 8 KB.
FRAME    := $(if $(filter -O2 -Os,$(CFLAGS)),-Wframe-larger-than=1024)

# The linker leaves out functions that a program does not call.
comma    := ,
LEAN     := -ffunction-sections -fdata-sections -fno-asynchronous-unwind-tables
# What -Os does not do by itself: 2 % of a small ladderd.
LEAN     += $(SMALL:1=-fno-inline-functions-called-once -fno-schedule-insns2 -fno-reorder-blocks)
# A static program has a fixed address; without MMU (SMALL=1) it can be loaded anywhere.
# There what starts it adds its place to addresses, and looks up no names: a linker for RISC-V keeps some of those that are not hidden.
LEAN     += $(if $(filter 1,$(STATIC)),$(if $(filter 1,$(SMALL)),-fvisibility=hidden,-fno-pie))
LEAN_LD  := -Wl,--gc-sections -Wl,-z,noseparate-code -Wl,--as-needed
# Tables of names have many pointers; packed, their relocations take 1 KB instead of 60.
LEAN_LD  += $(if $(STATIC),,$(if $(shell $(CC) -Wl,--help 2>/dev/null | grep -- '-z pack-relative-relocs'),-Wl$(comma)-z$(comma)pack-relative-relocs))

obj  = $(patsubst %.c,$(BUILD)/%.o,$(1))
# XML=libxml2|none: PLCopen XML is read by libxml2 if it is installed for the target, or not read.
XML      ?= $(if $(filter 1,$(STATIC) $(SMALL)),none,$(if $(if $(CROSS),$(PKG_CONFIG_LIBDIR),here),$(shell $(PKG_CONFIG) --exists libxml-2.0 2>/dev/null && echo libxml2)))
override XML := $(or $(XML),none)
XML_LIB  := $(if $(filter libxml2,$(XML)),$(shell $(PKG_CONFIG) --libs libxml-2.0))
ENGINE   := $(filter-out %_small.c %/xml_$(if $(filter libxml2,$(XML)),none,libxml2).c,$(wildcard runtime/engine/*.c runtime/engine/*/*.c runtime/engine/exchange/*/*.c))
$(call obj,runtime/engine/exchange/plcopen/xml_libxml2.c): override CPPFLAGS += $(if $(XML_LIB),$(shell $(PKG_CONFIG) --cflags libxml-2.0))
# The engine of a small board: without the files that read or translate, or that find, print or
# store something by name.
CORE     := $(wildcard runtime/engine/base/*.c runtime/engine/scan/*.c)
CORE     := $(filter-out $(if $(filter 1,$(SMALL)),$(addprefix runtime/engine/base/,catalog.c explain.c iec_print.c literal.c \
            name.c names.c nearest.c plain.c sink.c) $(addprefix runtime/engine/scan/,carry.c carry_losses.c carry_moves.c recorder.c \
            carry_plan.c code_print.c code_strip.c retain.c retain_plan.c retain_slot.c still.c still_table.c symbols.c symbol_index.c),%_small.c),$(CORE))
# SMALL=1 WORDS=core: without the rows MORE_FB and MORE_FN of catalog.def.
ifeq ($(WORDS),core)
CORE     := $(filter-out $(addprefix runtime/engine/base/,big.c decimal.c number.c) \
            $(addprefix runtime/engine/scan/,fb_alarm.c fb_analog.c fb_classic.c fb_clock.c fb_modbus.c fb_pid.c fb_pulse.c fb_store.c fb_sun.c fn_bits.c \
            fn_convert.c fn_real.c fn_select.c fn_string.c fn_text.c fn_text_to.c fn_time.c math.c math_angle.c \
            math_number.c math_table.c wide.c),$(CORE))
endif
LIBRARY  := $(if $(filter 1,$(SMALL)),$(CORE),$(ENGINE))
$(call obj,$(ENGINE)): WARN += $(FRAME)
# Without errno a square root is an instruction where the processor has one, and libm takes no memory.
$(call obj,$(addprefix runtime/engine/scan/,fn_real.c math_angle.c fb_sun.c)): CPPFLAGS += -fno-math-errno
# Files that run once per load are compiled for size; for boards, also some that make loading fast here.
OFTEN    := $(addprefix runtime/ladderd/,$(if $(CROSS)$(STATIC),,cycle.c) stats.c wall.c)
# Not for boards: those that run most while somebody who has changed a long text waits for it.
OFTEN    += $(if $(CROSS)$(STATIC)$(filter 1,$(SMALL)),,$(addprefix runtime/engine/,check/check_il.c check/check_operand.c \
            check/check_st.c check/infer.c check/scope.c scan/code.c scan/code_text.c text/read_st.c text/reader.c text/write_st.c \
            translate/pack_image.c))
ONCE     := $(wildcard runtime/engine/check/*.c runtime/engine/text/*.c runtime/ladderd/*.c runtime/online/*.c \
            $(addprefix runtime/engine/,base/diag.c base/nearest.c base/sink.c model/convert.c model/shape.c scan/carry_*.c scan/code*.c scan/declared.c \
            scan/retain_*.c scan/still_table.c scan/symbol*.c scan/place.c translate/call_own.c translate/layout_constant.c translate/pack_*.c) \
            hal/gpio_find.c hal/hal_open.c hal/iomap*.c hal/ports.c $(addprefix hal/,channels_run.c sysfs.c pwm.c w1.c hwmon.c said.c iio_none.c iio_libiio.c iio_calls.c))
ONCE     += $(if $(CROSS)$(STATIC),$(wildcard $(addprefix runtime/engine/,base/*.c model/*.c translate/*.c ladder.c \
            scan/carry.c scan/declared.c scan/recorder.c scan/fb_alarm.c scan/fb_analog.c scan/fb_classic.c scan/fb_clock.c scan/fb_modbus.c scan/fb_pid.c scan/fb_store.c scan/fb_sun.c scan/fn_bits.c scan/fn_convert.c \
            scan/fn_real.c scan/fn_select.c scan/fn_string.c scan/fn_text*.c scan/fn_time.c scan/math*.c scan/retain*.c \
            scan/fb_counter.c scan/fn_math.c scan/resource.c scan/wide.c) \
            hal/gpio_uapi.c hal/hal.c hal/sim.c hal/channels.c hal/channel_scale.c))
# Half a percent less for a board: what a loop does not change stays in it.
$(call obj,$(filter-out $(OFTEN),$(ONCE))): COLD = $(if $(filter -O2,$(CFLAGS)),-Os $(if $(CROSS)$(STATIC),-fno-move-loop-invariants))
# As much again where no scan comes.
$(call obj,$(filter-out runtime/engine/scan/% hal/% $(OFTEN),$(ONCE))): COLD += $(if $(filter -O2,$(CFLAGS)),$(if $(CROSS)$(STATIC),-fno-schedule-insns2 -fno-if-conversion))
# Where its branches lie decides about a tenth of the time of a scan on x86-64; without this, luck does. Boards have less room.
ALIGNED  := -falign-jumps=32 -falign-loops=32
$(call obj,runtime/engine/scan/vm.c): COLD = $(if $(filter -O2,$(CFLAGS)),$(if $(CROSS)$(STATIC)$(filter 1,$(SMALL)),,$(shell $(CC) -Werror $(ALIGNED) -x c -c /dev/null -o /dev/null 2>/dev/null && echo $(ALIGNED))))

all: $(BUILD)/libladder.a ## build everything that can be built here

$(BUILD)/libladder.a: $(call obj,$(LIBRARY))
	@rm -f $@
	$(AR) rcs $@ $^

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(CPPFLAGS) $(WARN) $(LEAN) $(CFLAGS) $(COLD) -MMD -MP -c -o $@ $<
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)

# ladder-modbus needs libmodbus. MODBUS=no leaves it out; so does a cross build that has no PKG_CONFIG_LIBDIR.
MODBUS   ?= $(if $(filter 1,$(SMALL)),,$(if $(if $(CROSS),$(PKG_CONFIG_LIBDIR),$(if $(filter 1,$(STATIC)),,here)),$(shell $(PKG_CONFIG) --exists libmodbus 2>/dev/null && echo yes)))
override MODBUS := $(filter yes,$(MODBUS))

# Tests are in folders like those of the sources: tests/unit/scan/test_fb.c. A new one is found by its name.
UNIT := $(patsubst tests/unit/%.c,$(BUILD)/unit/%,$(wildcard tests/unit/*/test_*.c tests/unit/*/*/test_*.c))
UNIT := $(filter-out $(if $(MODBUS),,$(BUILD)/unit/modbus/%),$(UNIT))
# The tests of a folder are one program (tests/room.c). Compiling them takes longer than running them: -O0, but not for an emulator.
TEST_C    = $(if $(CROSS),,$(if $(filter -O2,$(CFLAGS)),-O0 -U_FORTIFY_SOURCE))
ROOM_TEST = $(TEST_C) -DTEST_MAIN=main_$(notdir $*) -include tests/room.h -Wno-missing-prototypes
ROOM_C    = $(STD) $(CPPFLAGS) $(WARN) $(CFLAGS) -DTESTS='$(patsubst %,TEST(%),$(filter test_%,$(basename $(notdir $(filter %.o,$^)))))'
folders   = $(sort $(patsubst %/,%,$(dir $(1))))
define room # folder, its tests, their objects
$(1)/tests: tests/room.c $(3)
$(2): $(1)/tests
$(3): COLD = $$(ROOM_TEST)
endef
UNIT_ROOMS := $(call folders,$(UNIT))
$(foreach r,$(UNIT_ROOMS),$(eval $(call room,$r,$(filter $r/test_%,$(UNIT)),$(patsubst $(BUILD)/%,$(BUILD)/tests/%.o,$(filter $r/test_%,$(UNIT))))))
$(UNIT_ROOMS:%=%/tests): $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(ROOM_C) $(LDFLAGS) -o $@ $(filter %.c,$^) $(filter %.o,$^) $(filter %.a,$^) $(ROOM_LIB) -lm
$(UNIT): ; @ln -sf tests $@
unit: $(UNIT) ## build and run the unit tests
	prove -e '' $(UNIT)

$(BUILD)/unit/online/tests: $(call obj,$(filter-out %/finder_avahi.c,$(wildcard runtime/online/*.c tests/walker/random*.c tests/walker/words*.c)))
$(BUILD)/unit/ladderd/tests: $(call obj,runtime/ladderd/print_static.c runtime/ladderd/password.c runtime/ladderd/disk.c runtime/ladderd/stats.c runtime/ladderd/alarm_store.c runtime/online/alarms.c runtime/online/wire.c)
$(BUILD)/unit/modbus/tests: $(call obj,$(filter-out %/main.c %/session.c,$(wildcard runtime/modbus/*.c)) hal/buses.c hal/host.c)
$(BUILD)/unit/modbus/tests: private ROOM_LIB = $(MODBUS_LIB)
$(BUILD)/unit/modbus/tests: private LDFLAGS += -Wl,--gc-sections
$(BUILD)/unit/peer/tests: $(call obj,$(addprefix runtime/peer/,datagram.c inbox.c outbox.c) runtime/online/wire.c runtime/online/service.c)
$(BUILD)/unit/guard/tests: $(call obj,$(addprefix runtime/guard/,check.c files.c place.c text.c))
$(BUILD)/unit/ladder/tests: $(call obj,$(wildcard runtime/ladder/words*.c) runtime/ladder/foreign.c)
words: $(BUILD)/unit/ladder/test_words ## write docs/words.md anew from the catalogue
	$< --print > docs/words.md

# ---- HAL and runtime ----
# HAL=gpiod|uapi|none: the gpio driver uses libgpiod, the uAPI of the kernel, or is left out. By
# default it uses libgpiod if it is installed for the target; a cross build finds it only through
# PKG_CONFIG_LIBDIR.
GPIOD    ?= $(if $(filter uapi none,$(HAL))$(filter 1,$(SMALL)),,$(if $(if $(CROSS),$(PKG_CONFIG_LIBDIR),here),$(shell $(PKG_CONFIG) --modversion libgpiod 2>/dev/null | cut -d. -f1)))
override HAL := $(or $(HAL),$(if $(filter 1 2,$(GPIOD)),gpiod,uapi))
GPIO_C_gpiod := hal/gpiod_v$(GPIOD).c hal/gpio_find.c
GPIO_C_uapi  := hal/gpio_uapi.c hal/gpio_find.c
GPIO_C_none  := hal/gpiod_none.c
GPIO_C   := $(or $(GPIO_C_$(HAL)),$(error HAL=$(HAL): it is gpiod, uapi or none))
GPIO_CPP := $(if $(filter gpiod,$(HAL)),$(if $(filter 1 2,$(GPIOD)),$(shell $(PKG_CONFIG) --cflags libgpiod),$(error HAL=gpiod, but pkg-config finds no libgpiod 1 or 2)))
GPIO_LIB = $(if $(filter libiio,$(IIO)),-ldl) $(if $(filter gpiod,$(HAL)),$(shell $(PKG_CONFIG) --libs $(if $(findstring -static,$(LDFLAGS)),--static) libgpiod))
# IIO=libiio|none: the driver iio uses libiio if its header is installed for the target, or is left out. The library
# is loaded when a map needs it.
IIO      ?= $(if $(filter 1,$(STATIC) $(SMALL)),none,$(if $(if $(CROSS),$(PKG_CONFIG_LIBDIR),here),$(shell $(PKG_CONFIG) --exists libiio 2>/dev/null && echo libiio)))
override IIO := $(or $(IIO),none)
CHANNELS_C := $(addprefix hal/,channel_rows.c channel_scale.c channels.c channels_run.c sysfs.c pwm.c w1.c hwmon.c iio_none.c said.c)
IIO_C_none   := hal/iio_none.c
IIO_C_libiio := hal/iio_libiio.c hal/iio_calls.c
HAL_CORE := hal/hal.c hal/drivers.c hal/hal_open.c hal/iomap.c hal/iomap_program.c hal/sim.c $(if $(filter 1,$(SMALL)),,$(CHANNELS_C) hal/iomap_channel.c hal/iomap_net.c hal/ports.c)
DRIVERS  := $(call obj,$(patsubst hal/iio_none.c,$(IIO_C_$(IIO)),$(HAL_CORE)) $(GPIO_C))
# The program password needs libcrypt with yescrypt. CRYPT=no leaves it out; so does a cross build
# that has no PKG_CONFIG_LIBDIR, and one with another C library.
CRYPT    ?= $(if $(CROSS)$(filter 1,$(SMALL))$(findstring musl,$(CC)),$(if $(PKG_CONFIG_LIBDIR),$(shell $(PKG_CONFIG) --exists libcrypt 2>/dev/null && echo yes),no),$(shell $(PKG_CONFIG) --exists libcrypt 2>/dev/null && echo yes))
CRYPT_LIB := $(if $(filter yes,$(CRYPT)$(SMALL)),$(shell $(PKG_CONFIG) --libs $(if $(findstring -static,$(LDFLAGS)),--static) libcrypt))
LADDERD_NOT := $(if $(filter yes,$(CRYPT)),crypt_none,crypt_yescrypt) $(if $(filter 1,$(STATIC)),,print_static) $(if $(filter 1,$(SMALL)),source_any store_thread store_file link peer download asks gateways journal conf ends password guarded crypt_none crypt_yescrypt \
               $(if $(LINK),link_none,disk slots link_serial nameless),source_image store_none link_none link_serial nameless conf_none guarded_none)
LADDERD  := $(call obj,$(filter-out $(LADDERD_NOT:%=runtime/ladderd/%.c),$(wildcard runtime/ladderd/*.c)))
# Its own table of messages, without those that only a desk gives.
LADDERD  += $(if $(filter 1,$(SMALL)),,$(BUILD)/runtime/ladderd/diag_board.o)
$(BUILD)/runtime/ladderd/diag_board.o: runtime/engine/base/diag.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(CPPFLAGS) -DRUNGBOARD_BOARD $(WARN) $(LEAN) $(CFLAGS) $(if $(filter -O2,$(CFLAGS)),-Os) -MMD -MP -c -o $@ $<
# A static ladderd has its own printf(), without floating point.
PRINT    := $(if $(filter 1,$(STATIC)),$(patsubst %,-Wl$(comma)--wrap=%,printf fprintf vfprintf snprintf vsnprintf))
# Threads, for --retain and --link; older C libraries need the option.
THREADS  := $(if $(filter 1,$(SMALL)),,-pthread)
# The protocol between board and desk: both sides; each program links what it uses.
# AVAHI=no: without Avahi's library, which finds boards (ladder boards, the editor).
AVAHI    ?= $(if $(if $(CROSS),$(PKG_CONFIG_LIBDIR),$(if $(filter 1,$(STATIC)),,here)),$(shell $(PKG_CONFIG) --exists avahi-client 2>/dev/null && echo yes))
AVAHI_LIB := $(if $(filter yes,$(AVAHI)),$(shell $(PKG_CONFIG) --libs avahi-client))
ONLINE   := $(call obj,$(filter-out $(if $(filter yes,$(AVAHI)),%/finder_none.c,%/finder_avahi.c),$(wildcard runtime/online/*.c)))
# What a small board links of it.
ONLINE_SERIAL := $(if $(LINK),$(call obj,$(addprefix runtime/online/,port.c publish.c serial.c service.c status.c stored.c wire.c)))
$(DRIVERS) $(LADDERD) $(ONLINE): WARN += $(FRAME)
$(BUILD)/libonline.a: $(ONLINE)
	@rm -f $@
	$(AR) rcs $@ $^
$(DRIVERS): CPPFLAGS += $(GPIO_CPP)

all: $(BUILD)/ladderd $(if $(filter 1,$(SMALL)),,$(BUILD)/ladder-attach $(BUILD)/ladder-guard)
GUARD := $(call obj,$(wildcard runtime/guard/*.c))
$(GUARD): WARN += $(FRAME)
$(BUILD)/ladder-guard: $(GUARD)
	$(CC) $(CFLAGS) $(LDFLAGS) $(LEAN_LD) -o $@ $^
$(BUILD)/ladder-attach: $(call obj,$(wildcard runtime/attach/*.c))
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^
# A gateway: variables from board to board.
PEER := $(call obj,$(wildcard runtime/peer/*.c))
$(PEER): WARN += $(FRAME)
all: $(if $(filter 1,$(SMALL)),,$(BUILD)/ladder-peer)
$(BUILD)/ladder-peer: $(PEER) $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LEAN_LD) $(LDFLAGS) $(THREADS) -o $@ $^ $(GPIO_LIB) -lm
# The same with a socket in the folder where it runs.
$(BUILD)/tests/online/ladder-attach: runtime/attach/main.c
	@mkdir -p $(@D)
	$(CC) $(STD) $(CPPFLAGS) $(WARN) $(CFLAGS) -DLINK_SOCKET='"link"' $(LDFLAGS) -o $@ $<
$(BUILD)/ladderd: $(LADDERD) $(DRIVERS) $(if $(filter 1,$(SMALL)),$(ONLINE_SERIAL),$(BUILD)/libonline.a) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LEAN_LD) $(LDFLAGS) $(PRINT) $(THREADS) -o $@ $^ $(GPIO_LIB) $(CRYPT_LIB) -lm
# Bytes of stack, for compilers for machines without MMU.
$(BUILD)/ladderd $(BUILD)/ladderd-count: export STACK := 8192

MODBUS_LIB := $(if $(MODBUS),$(shell $(PKG_CONFIG) --libs libmodbus) -pthread)
MODBUS_O := $(if $(MODBUS),$(call obj,$(wildcard runtime/modbus/*.c)))
# What a machine lacks for the buses of a map.
BUSES    := $(call obj,hal/buses.c hal/host$(if $(filter 1,$(STATIC)),_static).c)
$(BUSES): WARN += $(FRAME)
$(MODBUS_O): WARN += $(FRAME)
$(MODBUS_O): override CPPFLAGS += $(if $(MODBUS),$(shell $(PKG_CONFIG) --cflags libmodbus))
all: $(if $(MODBUS),$(BUILD)/ladder-modbus,$(if $(CROSS)$(filter 1,$(SMALL) $(STATIC)),,no-modbus))
no-modbus: ; @echo "make: ladder-modbus is left out: it needs libmodbus" >&2
.PHONY: no-modbus
$(BUILD)/ladder-modbus: $(MODBUS_O) $(BUSES) $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LEAN_LD) $(LDFLAGS) -o $@ $^ $(GPIO_LIB) $(MODBUS_LIB) -lm

# All gpio drivers with fakes of libgpiod and the kernel: one suite, built three times.
HAL_TEST := $(BUILD)/tests/hal
HAL_FAKE  = $(call obj,$(filter-out hal/iio_none.c,$(HAL_CORE))) $(HAL_TEST)/fake_iio/iio_libiio.o \
            $(HAL_TEST)/fake_iio/fake_iio.o $(HAL_TEST)/$(1)/$(2).o \
            $(HAL_TEST)/$(1)/gpio_find.o $(HAL_TEST)/$(1)/fake_$(1).o $(HAL_TEST)/fake.o
$(HAL_TEST)/v1/%.o: hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_v1 $(CPPFLAGS) $(WARN) $(FRAME) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/v2/%.o: hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_v2 $(CPPFLAGS) $(WARN) $(FRAME) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/v1/%.o: tests/hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_v1 $(CPPFLAGS) $(WARN) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/v2/%.o: tests/hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_v2 $(CPPFLAGS) $(WARN) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/uapi/%.o: hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(CPPFLAGS) $(WARN) $(FRAME) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/uapi/%.o: tests/hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(CPPFLAGS) $(WARN) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/suite_%: $(HAL_TEST)/%/suite.o $(BUILD)/libladder.a Makefile
	$(CC) $(CFLAGS) $(LDFLAGS) $(WRAP) -Wl,--wrap=malloc,--wrap=calloc,--wrap=mmap64 -o $@ $(filter %.o,$^) $(filter %.a,$^) -lm
$(HAL_TEST)/suite_v1: $(call HAL_FAKE,v1,gpiod_v1)
$(HAL_TEST)/suite_v2: $(call HAL_FAKE,v2,gpiod_v2)
$(HAL_TEST)/suite_uapi: $(call HAL_FAKE,uapi,gpio_uapi)
$(HAL_TEST)/suite_uapi $(HAL_TEST)/ladderd_uapi: WRAP := -Wl,--wrap=open,--wrap=open64,--wrap=close,--wrap=ioctl
$(HAL_TEST)/map: $(call obj,tests/hal/map.c tests/hal/fake.c $(HAL_CORE) hal/gpiod_none.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
$(HAL_TEST)/channel_map: $(call obj,tests/hal/channel_map.c tests/hal/fake.c $(HAL_CORE) hal/gpiod_none.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
# Channels of analog values, with files in place of the kernel's.
$(HAL_TEST)/channels: $(call obj,tests/hal/channels.c $(HAL_CORE) hal/gpiod_none.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) -o $@ $(filter %.o,$^) $(filter %.a,$^) -lm
# The driver iio, with a fake of libiio and, where it is installed, with the library itself.
$(HAL_TEST)/fake_iio/%.o: hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_iio $(CPPFLAGS) $(WARN) $(FRAME) $(CFLAGS) -MMD -MP -c -o $@ $<
$(HAL_TEST)/fake_iio/%.o: tests/hal/%.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) -Itests/hal/fake_iio $(CPPFLAGS) $(WARN) $(CFLAGS) -MMD -MP -c -o $@ $<
IIO_TEST := $(call obj,tests/hal/iio.c $(filter-out hal/iio_none.c,$(HAL_CORE)) hal/gpiod_none.c)
$(HAL_TEST)/iio_fake: $(HAL_TEST)/fake_iio/iio_libiio.o $(HAL_TEST)/fake_iio/fake_iio.o
$(HAL_TEST)/iio_real: $(call obj,$(IIO_C_libiio) tests/hal/iio_sys.c)
$(HAL_TEST)/iio_real: LIBIIO = -Wl,--export-dynamic -ldl
$(HAL_TEST)/iio_fake $(HAL_TEST)/iio_real: $(IIO_TEST) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(LIBIIO) -lm
SYS_FAKE := -Wl,--wrap=iomap_read,--wrap=pwrite,--wrap=pwrite64
$(HAL_TEST)/ladderd_%: $(LADDERD) $(HAL_TEST)/%/daemon_fake.o $(HAL_TEST)/sys_fake.o $(BUILD)/libonline.a $(BUILD)/libladder.a Makefile
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) $(WRAP) $(SYS_FAKE) -Wl,--wrap=opendir,--wrap=fdatasync -o $@ $(filter %.o,$^) $(filter %.a,$^) $(CRYPT_LIB) -lm
$(HAL_TEST)/ladderd_v1: $(call HAL_FAKE,v1,gpiod_v1)
$(HAL_TEST)/ladderd_v2: $(call HAL_FAKE,v2,gpiod_v2)
$(HAL_TEST)/ladderd_uapi: $(call HAL_FAKE,uapi,gpio_uapi)
# ladderd and ladder-guard with lines that both share; files in place of converters and pulse widths.
GUARD_FAKES := $(HAL_TEST)/guarded_ladderd $(HAL_TEST)/guarded_guard
GUARD_WRAP  := -Wl,--wrap=open,--wrap=open64,--wrap=close,--wrap=ioctl,--wrap=opendir,--wrap=poll,--wrap=syscall,--wrap=waitpid
$(HAL_TEST)/guarded_ladderd: $(LADDERD) $(call obj,tests/hal/guard_fake.c tests/hal/sys_fake.c $(filter-out hal/iio_none.c,$(HAL_CORE)) hal/gpio_find.c hal/gpio_uapi.c) \
                            $(HAL_TEST)/fake_iio/iio_libiio.o $(HAL_TEST)/fake_iio/fake_iio.o $(BUILD)/libonline.a $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) $(GUARD_WRAP) $(SYS_FAKE) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(CRYPT_LIB) -lm
$(HAL_TEST)/guarded_guard: $(GUARD) $(call obj,tests/hal/guard_fake.c)
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) $(GUARD_WRAP) -o $@ $^
# ladderd on a disk that fails.
SICK_DISK := $(HAL_TEST)/sick_ladderd
$(SICK_DISK): WRAP := $(patsubst %,-Wl$(comma)--wrap=%,open open64 close mkstemp mkstemp64 fsync fdatasync ftruncate ftruncate64 rename read write pread pread64 pwrite pwrite64)
$(SICK_DISK): $(LADDERD) $(DRIVERS) $(call obj,tests/hal/disk_fake.c) $(BUILD)/libonline.a $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) $(WRAP) -o $@ $^ $(GPIO_LIB) $(CRYPT_LIB) -lm
HAL_KINDS := v1 v2 uapi
HAL_TESTS := $(HAL_TEST)/map $(HAL_TEST)/iio_fake $(if $(filter libiio,$(IIO)),$(HAL_TEST)/iio_real) $(HAL_TEST)/channel_map $(HAL_TEST)/channels $(HAL_KINDS:%=$(HAL_TEST)/suite_%)
HAL_DAEMONS := $(HAL_KINDS:%=$(HAL_TEST)/ladderd_%) $(GUARD_FAKES) $(SICK_DISK)
hal-tests: $(HAL_TESTS) $(BUILD)/ladderd $(BUILD)/ladder $(HAL_DAEMONS) ## all gpio drivers with fake chips; ladderd from outside
	BUILD=$(BUILD) prove -j2 -e '' $(HAL_TESTS) tests/hal/ladderd.t tests/hal/channels.t tests/hal/guard.t tests/hal/retain.t
check-retain: all ## ladderd --retain killed 1,000 times; `check` does 400 of them
	BUILD=$(BUILD) RETAIN_KILLS=1000 prove -v -e '' tests/hal/retain.t
.PHONY: check-retain
.PRECIOUS: $(HAL_KINDS:%=$(HAL_TEST)/%/%.o)
.PHONY: hal-tests
# ---- end of HAL and runtime ----

# ---- the command line: ladder, its man pages ----
LADDER := $(call obj,$(wildcard runtime/ladder/*.c)) $(BUSES)
all: $(if $(filter 1,$(SMALL)),,$(BUILD)/ladder)
$(BUILD)/ladder: $(LADDER) $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(GPIO_LIB) $(AVAHI_LIB) $(XML_LIB) -lm

# From the rows of runtime/ladder/commands.def, by a program that runs here, also in a cross build.
HERE := $(if $(CROSS),build/here,$(BUILD))
ifneq ($(HERE),$(BUILD))
$(HERE)/%: FORCE
	env -u PKG_CONFIG_LIBDIR -u CPPFLAGS -u CFLAGS -u LDFLAGS $(MAKE) BUILD=$(HERE) CROSS= STATIC= SMALL= HAL=none $@
FORCE:
# One after another: each is a make of its own in the same folder.
$(HERE)/ladder: | $(HERE)/rung-language
$(HERE)/ladderd: | $(HERE)/ladder
$(HERE)/editor-usage: | $(HERE)/ladderd
endif
man: $(HERE)/ladder ## the man pages, in build/man/
	@mkdir -p $(BUILD)/man
	@$(HERE)/ladder help --man >$(BUILD)/man/ladder.1
	@for c in $$($(HERE)/ladder help --names); do \
	  $(HERE)/ladder help --man $$c >$(BUILD)/man/ladder-$$c.1 || exit 1; done
install: $(if $(filter 1,$(SMALL)),,install-ladder) install-ladderd ## install under $(DESTDIR)$(prefix)
install-ladder: $(BUILD)/ladder man
	install -d $(DESTDIR)$(prefix)/bin $(DESTDIR)$(prefix)/share/man/man1
	install -m 755 $(BUILD)/ladder $(DESTDIR)$(prefix)/bin/ladder
	install -m 644 $(BUILD)/man/*.1 $(DESTDIR)$(prefix)/share/man/man1/
# The page of ladderd is made from its --help. The unit and its defaults go to the places of Debian.
$(BUILD)/man/ladderd.8: $(HERE)/ladderd
	@mkdir -p $(@D)
	@{ printf '.TH LADDERD 8 "" "Rungboard" "Rungboard"\n.SH NAME\nladderd \\- runs a ladder program on the pins of this machine\n'; \
	  printf '.SH SYNOPSIS\n.B ladderd\n.I FILE\n.B \\-\\-io\n.I MAP\n[OPTION]...\n.SH DESCRIPTION\n.nf\n'; \
	  $< --help | sed -e '1d' -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; printf '.fi\n.SH SEE ALSO\n.BR ladder (1)\n'; } >$@
$(BUILD)/man/ladder-attach.1: Makefile
	@mkdir -p $(@D)
	@{ printf '.TH LADDER-ATTACH 1 "" "Rungboard" "Rungboard"\n.SH NAME\nladder-attach \\- joins a stream to ladderd on this board\n'; \
	  printf '.SH SYNOPSIS\n.B ladder-attach\n.SH DESCRIPTION\nJoins standard input and output to the socket of ladderd. ssh runs it for\n.BR ladder-board (1);\n'; \
	  printf 'it takes no argument.\n.SH FILES\n.I /run/rungboard/link\n.SH EXIT STATUS\n0 one side has ended; 1 no ladderd; 2 wrong usage.\n.SH SEE ALSO\n.BR ladderd (8)\n'; } >$@
# The page of ladder-guard is made from its --help.
$(BUILD)/man/ladder-guard.8: $(HERE)/ladder-guard
	@mkdir -p $(@D)
	@{ printf '.TH LADDER-GUARD 8 "" "Rungboard" "Rungboard"\n.SH NAME\nladder-guard \\- makes outputs safe when ladderd dies or freezes\n'; \
	  printf '.SH SYNOPSIS\n.B ladder-guard\n[OPTION]... \\-\\- ladderd ARGUMENT...\n.SH DESCRIPTION\n.nf\n'; \
	  $< --help | sed -e '1d' -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; printf '.fi\n.SH SEE ALSO\n.BR ladderd (8)\n'; } >$@
# So is that of ladder-peer.
$(BUILD)/man/ladder-peer.8: $(HERE)/ladder-peer
	@mkdir -p $(@D)
	@{ printf '.TH LADDER-PEER 8 "" "Rungboard" "Rungboard"\n.SH NAME\nladder-peer \\- variables from board to board\n'; \
	  printf '.SH SYNOPSIS\n.B ladder-peer\n[OPTION]...\n.SH DESCRIPTION\n.nf\n'; \
	  $< --help | sed -e '1d' -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; printf '.fi\n.SH SEE ALSO\n.BR ladderd (8)\n'; } >$@
man: $(BUILD)/man/ladderd.8 $(BUILD)/man/ladder-attach.1 $(BUILD)/man/ladder-guard.8 $(BUILD)/man/ladder-peer.8
unitdir ?= /lib/systemd/system
install-ladderd: $(BUILD)/ladderd $(if $(filter 1,$(SMALL)),,$(BUILD)/ladder-attach $(BUILD)/ladder-guard $(BUILD)/ladder-peer $(BUILD)/man/ladder-guard.8 $(BUILD)/man/ladder-peer.8 $(BUILD)/man/ladder-attach.1) $(BUILD)/man/ladderd.8
	install -d $(DESTDIR)$(prefix)/bin $(DESTDIR)$(prefix)/share/man/man8 \
	  $(DESTDIR)$(unitdir) $(DESTDIR)/etc/default
	install -m 755 $(BUILD)/ladderd $(if $(filter 1,$(SMALL)),,$(BUILD)/ladder-attach $(BUILD)/ladder-guard $(BUILD)/ladder-peer) $(DESTDIR)$(prefix)/bin/
	install -m 644 $(BUILD)/man/ladderd.8 $(if $(filter 1,$(SMALL)),,$(BUILD)/man/ladder-guard.8 $(BUILD)/man/ladder-peer.8) $(DESTDIR)$(prefix)/share/man/man8/
	$(if $(filter 1,$(SMALL)),,install -d $(DESTDIR)$(prefix)/share/man/man1 && install -m 644 $(BUILD)/man/ladder-attach.1 $(DESTDIR)$(prefix)/share/man/man1/)
	$(if $(filter 1,$(SMALL)),,sed -e 's|/usr/bin/ladder|$(prefix)/bin/ladder|g' packaging/ladder-peer.service >$(DESTDIR)$(unitdir)/ladder-peer.service)
	sed $(SMALL:1=-e 's|/usr/bin/ladder-guard.* -- ||' -e 's|=/usr/bin/ladder-guard |=|') -e 's|/usr/bin/ladder|$(prefix)/bin/ladder|g' packaging/ladderd.service >$(DESTDIR)$(unitdir)/ladderd.service
	test -e $(DESTDIR)/etc/default/ladderd || { sed '$(SMALL:1=s| --retain [^"]*||)' packaging/ladderd.default \
	  >$(DESTDIR)/etc/default/ladderd && chmod 644 $(DESTDIR)/etc/default/ladderd; }
# The page of ladder-modbus is made from its --help, too.
$(BUILD)/man/ladder-modbus.8: $(HERE)/ladder-modbus
	@mkdir -p $(@D)
	@{ printf '.TH LADDER-MODBUS 8 "" "Rungboard" "Rungboard"\n.SH NAME\nladder-modbus \\- devices with Modbus for ladderd\n'; \
	  printf '.SH SYNOPSIS\n.B ladder-modbus\n[OPTION]...\n.SH DESCRIPTION\n.nf\n'; \
	  $< --help | sed -e '1d' -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; printf '.fi\n.SH SEE ALSO\n.BR ladderd (8)\n'; } >$@
man: $(if $(MODBUS),$(BUILD)/man/ladder-modbus.8)
# A gateway is a service of its own, which a person starts.
install: $(if $(MODBUS),install-modbus)
install-modbus: $(BUILD)/ladder-modbus $(BUILD)/man/ladder-modbus.8
	install -d $(DESTDIR)$(prefix)/bin $(DESTDIR)$(prefix)/share/man/man8 $(DESTDIR)$(unitdir)
	install -m 755 $(BUILD)/ladder-modbus $(DESTDIR)$(prefix)/bin/
	install -m 644 $(BUILD)/man/ladder-modbus.8 $(DESTDIR)$(prefix)/share/man/man8/
	sed 's|/usr/bin/ladder|$(prefix)/bin/ladder|g' packaging/ladder-modbus.service >$(DESTDIR)$(unitdir)/ladder-modbus.service
.PHONY: install-modbus
cli-tests: $(BUILD)/ladder ## the command line from outside
	LADDER=$(BUILD)/ladder prove tests/cli.t
.PHONY: man install install-ladder install-ladderd cli-tests
# ---- end of the command line ----

# ---- the editor: GTK 4, libadwaita, GtkSourceView ----
# Without those libraries it is left out; a cross build finds them only through PKG_CONFIG_LIBDIR.
# Its plain files and their tests
# (tests/editor/edit/ and test_plain_*.c) need none of them.
EDITOR_NEEDS := gtk4 >= 4.8 libadwaita-1 >= 1.2 gtksourceview-5 >= 5.6
EDITOR   := $(if $(filter 1,$(SMALL))$(if $(CROSS),$(if $(PKG_CONFIG_LIBDIR),,without)),,$(shell $(PKG_CONFIG) --exists '$(EDITOR_NEEDS)' 2>/dev/null && echo yes))
EDITOR_ROOMS := $(addprefix editor-gtk/,kit/gtk48 kit edit draw document sim online canvas ladder sfc fbd text iomap live panels render window)
EDITOR_PLAIN := $(wildcard editor-gtk/edit/*.c) $(addprefix editor-gtk/document/,text_lines.c iomap_text.c iomap_uses.c iomap_check.c)
# MD4C=no: without the library for the pages of the manual, which another program shows then.
MD4C     ?= $(shell $(PKG_CONFIG) --exists md4c 2>/dev/null && echo yes)
EDITOR_C := $(filter-out $(if $(filter yes,$(MD4C)),%/markdown_none.c,%/markdown_md4c.c),$(wildcard $(EDITOR_ROOMS:%=%/*.c)))
EDITOR_TESTS_PLAIN := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/editor/edit/test_*.c tests/editor/*/test_plain_*.c))
EDITOR_TESTS := $(EDITOR_TESTS_PLAIN)
$(BUILD)/libeditor-plain.a: $(call obj,$(EDITOR_PLAIN))
	@rm -f $@
	$(AR) rcs $@ $^
# A test_plain_* is in a folder of tests that need the toolkit, so it is a separate program.
PLAIN_ALONE := $(foreach t,$(EDITOR_TESTS_PLAIN),$(if $(findstring /test_plain_,$t),$t))
PLAIN_ROOM  := $(filter-out $(PLAIN_ALONE),$(EDITOR_TESTS_PLAIN))
$(PLAIN_ALONE:%=%.o): COLD = $(TEST_C)
$(PLAIN_ALONE): $(BUILD)/%: $(BUILD)/%.o $(BUILD)/libeditor-plain.a $(call obj,$(HAL_CORE) hal/gpiod_none.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(THREADS) -o $@ $^ -lm
$(foreach r,$(call folders,$(PLAIN_ROOM)),$(eval $(call room,$r,$(filter $r/test_%,$(PLAIN_ROOM)),$(patsubst %,%.o,$(filter $r/test_%,$(PLAIN_ROOM))))))
$(patsubst %,%/tests,$(call folders,$(PLAIN_ROOM))): $(BUILD)/libeditor-plain.a $(BUILD)/libladder.a
	$(CC) $(ROOM_C) $(LDFLAGS) -o $@ $(filter %.c,$^) $(filter %.o,$^) $(filter %.a,$^) -lm
$(PLAIN_ROOM): ; @ln -sf tests $@
# Two programs that run during a build, also in a cross build. The first writes the colours of rung
# files and lists for GtkSourceView, from the words of the catalogue; the second the man page.
$(BUILD)/rung-language: $(call obj,packaging/rung_language.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
$(BUILD)/editor-usage: packaging/editor_usage.c editor-gtk/window/usage.c editor-gtk/kit/verbs.c editor-gtk/kit/verbs.def editor-gtk/kit/key_schemes.def $(BUILD)/libladder.a
	$(CC) $(STD) $(CPPFLAGS) $$($(PKG_CONFIG) --cflags gtk4) -DGETTEXT_PACKAGE='"rungboard"' $(CFLAGS) $(LDFLAGS) \
	  -o $@ $(filter %.c %.a,$^) $$($(PKG_CONFIG) --libs gtk4) -lm
ifneq ($(EDITOR),)
# No warnings about headers of libraries.
EDITOR_PKG := gtk4 libadwaita-1 gtksourceview-5 $(if $(filter yes,$(MD4C)),md4c)
EDITOR_CPP := $(patsubst -I%,-isystem %,$(shell $(PKG_CONFIG) --cflags $(EDITOR_PKG))) -I$(BUILD)
EDITOR_LIB := $(shell $(PKG_CONFIG) --libs $(EDITOR_PKG)) $(GPIO_LIB) $(AVAHI_LIB) $(XML_LIB)
EDITOR_TESTS += $(filter-out $(EDITOR_TESTS_PLAIN),$(patsubst %.c,$(BUILD)/%,$(wildcard tests/editor/*/test_*.c tests/editor/*/*/test_*.c)))
EDITOR_BENCH := $(BUILD)/tests/editor/bench_drawing
EDITOR_OBJ := $(call obj,$(filter-out editor-gtk/window/main.c,$(EDITOR_C))) $(BUILD)/editor-gtk/resources.o
EDITOR_RES := $(wildcard editor-gtk/*.gresource.xml)
EDITOR_O := $(filter-out $(call obj,$(EDITOR_PLAIN)),$(call obj,$(EDITOR_C)))
EDITOR_TEST_O := $(patsubst %,%.o,$(filter-out $(EDITOR_TESTS_PLAIN),$(EDITOR_TESTS)))
$(EDITOR_O) $(BUILD)/editor-gtk/resources.o $(EDITOR_TEST_O) $(EDITOR_BENCH).o: CPPFLAGS += $(EDITOR_CPP) -DGETTEXT_PACKAGE='"rungboard"'
# The libraries' headers are compiled once for the sources, once for the tests, which have other flags.
EDITOR_H := $(BUILD)/toolkit.h $(BUILD)/tests/toolkit.h
EDITOR_H_C := $(STD) $(CPPFLAGS) $(EDITOR_CPP) $(LEAN) $(CFLAGS)
$(EDITOR_H): ; @mkdir -p $(@D) && echo '#include <adwaita.h>' >$@
$(BUILD)/tests/toolkit.h.gch: private EDITOR_H_C += $(TEST_C)
$(EDITOR_H:%=%.gch): %.gch: % Makefile
	$(CC) $(EDITOR_H_C) -MD -MP -MF $*.d -MT $@ -x c-header -o $@ $<
$(EDITOR_O): private CPPFLAGS += -include $(BUILD)/toolkit.h
$(EDITOR_O): | $(BUILD)/toolkit.h.gch
$(EDITOR_TEST_O): private CPPFLAGS += -include $(BUILD)/tests/toolkit.h
$(EDITOR_TEST_O): | $(BUILD)/tests/toolkit.h.gch
$(BUILD)/rung.lang: $(HERE)/rung-language
	@mkdir -p $(@D)
	$< >$@.new && mv $@.new $@
$(BUILD)/rung-st.lang: $(HERE)/rung-language
	@mkdir -p $(@D)
	$< st >$@.new && mv $@.new $@
$(BUILD)/editor-gtk/resources.c: $(EDITOR_RES) $(BUILD)/rung.lang $(BUILD)/rung-st.lang $(wildcard editor-gtk/ui/*)
	@mkdir -p $(@D)
	glib-compile-resources --sourcedir=editor-gtk --sourcedir=packaging --sourcedir=$(BUILD) --target=$@ --generate-source --c-name rungboard editor-gtk/rungboard.gresource.xml
$(BUILD)/editor-gtk/resources.o: $(BUILD)/editor-gtk/resources.c
	$(CC) $(STD) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<
$(BUILD)/libeditor.a: $(EDITOR_OBJ)
	@rm -f $@
	$(AR) rcs $@ $^
all: $(BUILD)/ladder-editor $(BUILD)/ladders $(BUILD)/docs
# Samples and manual are beside the program, whatever BUILD is.
$(BUILD)/ladders $(BUILD)/docs:
	ln -sfn '$(CURDIR)/$(@F)' $@
$(BUILD)/ladder-editor: $(BUILD)/editor-gtk/window/main.o $(BUILD)/libeditor.a $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -Wl,--gc-sections -o $@ $< -Wl,--whole-archive $(BUILD)/libeditor.a -Wl,--no-whole-archive $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a $(EDITOR_LIB) -lm
GTK_TESTS := $(filter-out $(EDITOR_TESTS_PLAIN),$(EDITOR_TESTS))
GTK_TEST_ROOMS := $(call folders,$(GTK_TESTS))
$(foreach r,$(GTK_TEST_ROOMS),$(eval $(call room,$r,$(filter $r/test_%,$(GTK_TESTS)),$(patsubst %,%.o,$(filter $r/test_%,$(GTK_TESTS))))))
$(GTK_TESTS): ; @ln -sf tests $@
$(EDITOR_BENCH): $(EDITOR_BENCH).o
$(EDITOR_BENCH): ROOM_C = $(CFLAGS)
$(EDITOR_BENCH) $(GTK_TEST_ROOMS:%=%/tests): $(BUILD)/libeditor.a $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(ROOM_C) $(LDFLAGS) -o $@ $(filter %.c,$^) $(filter %.o,$^) -Wl,--whole-archive $(BUILD)/libeditor.a -Wl,--no-whole-archive $(BUILD)/libonline.a $(BUILD)/libladder.a $(EDITOR_LIB) -lm
else
all: no-editor
no-editor: ; @$(if $(CROSS)$(filter 1,$(SMALL)),,echo "make: ladder-editor is left out: it needs $(EDITOR_NEEDS)" >&2)
.PHONY: no-editor
endif
# Scripts that use pointer and keys like a person, on a screen of their own. PICTURES=folder keeps screenshots.
EDITOR_PERSON := $(if $(EDITOR),$(shell grep -l '^\#!' tests/editor/person/*.py))
# Its languages: editor-gtk/po/. In the build they are beside the program, in build/locale/.
MSGFMT   := $(if $(EDITOR),$(shell command -v msgfmt))
MO       := $(if $(MSGFMT),$(patsubst %,$(BUILD)/locale/%/LC_MESSAGES/rungboard.mo,$(shell cat editor-gtk/po/LINGUAS)))
all: $(MO)
$(BUILD)/locale/%/LC_MESSAGES/rungboard.mo: editor-gtk/po/%.po
	@mkdir -p $(@D)
	msgfmt -c -o $@ $<
ifeq ($(MSGFMT),)
all: $(if $(EDITOR),no-languages)
no-languages: ; @echo "make: the editor's languages are left out: they need msgfmt (gettext)" >&2
.PHONY: no-languages
endif
pot: ## the editor's texts, for translators: build/rungboard.pot
	@mkdir -p $(BUILD)
	@CC='$(CC)' editor-gtk/po/pot.sh $(BUILD)/rungboard.pot
po: pot ## bring new texts into editor-gtk/po/*.po
	@for l in $$(cat editor-gtk/po/LINGUAS); do msgmerge -q -U -N --backup=none --add-location=file editor-gtk/po/$$l.po $(BUILD)/rungboard.pot && \
	  msgattrib --no-obsolete --add-location=file -o editor-gtk/po/$$l.po editor-gtk/po/$$l.po && echo "$$l: $$(msgfmt --statistics -o /dev/null editor-gtk/po/$$l.po 2>&1)" || exit 1; done
.PHONY: pot po
ifneq ($(EDITOR),)
$(BUILD)/man/ladder-editor.1: $(HERE)/editor-usage
	@mkdir -p $(@D)
	@LC_ALL=C.UTF-8 $< --man >$@
man: $(BUILD)/man/ladder-editor.1
endif
# Files that a desktop needs to find the editor.
install: $(if $(EDITOR),install-editor)
appdir = $(DESTDIR)$(prefix)/share
install-editor: $(BUILD)/ladder-editor $(MO)
	install -d $(DESTDIR)$(prefix)/bin $(appdir)/applications $(appdir)/metainfo $(appdir)/mime/packages \
	  $(appdir)/icons/hicolor/scalable/apps $(appdir)/glib-2.0/schemas $(appdir)/rungboard/ladders/boards $(appdir)/rungboard/docs/tutorial \
	  $(appdir)/gtksourceview-5/language-specs
	install -m 755 $(BUILD)/ladder-editor $(DESTDIR)$(prefix)/bin/ladder-editor
	install -m 644 packaging/org.rungboard.Editor.desktop $(appdir)/applications/
	install -m 644 packaging/org.rungboard.Editor.metainfo.xml $(appdir)/metainfo/
	install -m 644 packaging/rungboard.xml $(appdir)/mime/packages/
	install -m 644 packaging/org.rungboard.Editor.svg $(appdir)/icons/hicolor/scalable/apps/
	install -m 644 packaging/org.rungboard.Editor.gschema.xml $(appdir)/glib-2.0/schemas/
	install -m 644 $(BUILD)/rung.lang $(BUILD)/rung-st.lang $(appdir)/gtksourceview-5/language-specs/
	install -m 644 ladders/*.rung ladders/*.scn $(appdir)/rungboard/ladders/
	$(foreach s,$(wildcard ladders/*/*.st ladders/cement-plant/* ladders/boiler-room/*),install -Dm 644 $s $(appdir)/rungboard/$s;)
	install -m 644 ladders/boards/*.io $(appdir)/rungboard/ladders/boards/
	install -m 644 docs/*.md docs/*.png $(appdir)/rungboard/docs/
	install -m 644 docs/tutorial/* $(appdir)/rungboard/docs/tutorial/
	$(foreach m,$(MO),install -Dm 644 $m $(appdir)/$(m:$(BUILD)/%=%);)
	$(if $(DESTDIR),,-glib-compile-schemas $(appdir)/glib-2.0/schemas; update-mime-database $(appdir)/mime; update-desktop-database $(appdir)/applications)
.PHONY: install-editor
# In the build the schema is beside the program: GSETTINGS_SCHEMA_DIR=build/schemas.
$(BUILD)/schemas/gschemas.compiled: packaging/org.rungboard.Editor.gschema.xml
	@mkdir -p $(@D)
	glib-compile-schemas --strict --targetdir=$(@D) packaging
all: $(if $(EDITOR),$(BUILD)/schemas/gschemas.compiled)
pictures: $(BUILD)/ladder-editor ## draw docs/tutorial/*.svg again, from the rung files beside them
	$(foreach r,$(wildcard docs/tutorial/*.rung),$< --render $r -o $(r:.rung=.svg) &&) :
screenshots: pictures $(BUILD)/schemas/gschemas.compiled ## the same, and docs/editor.png, the windows of the tutorial and the pictures of charts
	$(BUILD)/ladder-editor --render ladders/sequence-s0-s8.rung -o docs/sequence-s0-s8.png
	$(BUILD)/ladder-editor --render ladders/boiler-room/boiler-room.rung --pou Values -o docs/boiler-room.png
	$(BUILD)/ladder-editor --render ladders/cement-plant/cement-plant.rung --pou Mixer -o docs/cement-plant.png
	$(BUILD)/ladder-editor --render ladders/cement-plant/cement-plant.rung --pou Drives --rung 4 -o docs/cement-plant-screw.png
	$(BUILD)/ladder-editor --render tests/classic/projects/linuxcnc.clp --rung 3 --before-after -o docs/from-classicladder.png
	$(foreach p,editor tutorial/empty tutorial/sealed tutorial/states,BUILD=$(BUILD) tests/editor/screenshot.py docs/$p.png &&) :
.PHONY: pictures screenshots
# The editor with the fake chips of the HAL tests, for the lines of a machine.
EDITOR_FAKE := $(HAL_TEST)/editor_v2
$(EDITOR_FAKE): $(BUILD)/editor-gtk/window/main.o $(HAL_TEST)/v2/io_fake.o $(call HAL_FAKE,v2,gpiod_v2) $(BUILD)/libeditor.a $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -Wl,--wrap=opendir,--wrap=fopen,--wrap=fopen64,--wrap=iomap_read -o $@ $(filter %.o,$^) \
	  -Wl,--whole-archive $(BUILD)/libeditor.a -Wl,--no-whole-archive $(BUILD)/libonline.a $(BUILD)/libladder.a $(EDITOR_LIB) -lm
# The scripts that use the editor as a person does load it into the editor. With sanitizers they do without.
EDITOR_WALK := $(BUILD)/tests/editor/person/walk.so
$(EDITOR_WALK): tests/editor/person/walk.c Makefile
	@mkdir -p $(@D)
	$(CC) $(STD) $(CFLAGS) $(shell pkg-config --cflags gio-2.0) -fPIC -shared -o $@ $< $(shell pkg-config --libs gio-2.0) -ldl
editor-tests: $(EDITOR_TESTS) $(EDITOR_FAKE) $(EDITOR_WALK) $(BUILD)/ladder all ## the editor's tests: without a display, and as a person
	BUILD=$(BUILD) prove -e '' $(EDITOR_TESTS) $(EDITOR_PERSON)
BENCH_EDITOR := $(addprefix $(BUILD)/tests/bench/,editor.o editor_ground.o editor_start.o)
$(BENCH_EDITOR): CPPFLAGS += $(EDITOR_CPP)
$(BUILD)/tests/bench/editor: $(BENCH_EDITOR) $(BUILD)/libeditor.a $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^) -Wl,--whole-archive $(BUILD)/libeditor.a -Wl,--no-whole-archive $(BUILD)/libonline.a $(BUILD)/libladder.a $(EDITOR_LIB) -lm
bench-editor: $(BUILD)/tests/bench/editor $(EDITOR_BENCH) ## measure drawing 5,000 rungs, and the whole editor with them
	@perl tests/bench/programs.pl mixed 5000 >$(BUILD)/bench-editor.rung
	@perl tests/bench/programs.pl lively 5000 >$(BUILD)/bench-lively.rung
	@perl tests/bench/programs.pl chart 1000 >$(BUILD)/bench-chart.rung
	@perl tests/bench/programs.pl lines 10000 >$(BUILD)/bench-lines.rung
	@perl tests/bench/programs.pl blocks 10000 >$(BUILD)/bench-blocks.rung
	@perl tests/bench/programs.pl network 300 >$(BUILD)/bench-networks.rung
	@$(EDITOR_BENCH)
	@GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-editor.rung ladders/garage-door.rung 2>/dev/null
	@echo "All rungs change in each scan:"; GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-lively.rung ladders/garage-door.rung Simulating 2>/dev/null | grep -E '^(Simulating|Lateness|Showing|In STOP)'
	@echo "10,000 lines of Structured Text in one program:"; GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-lines.rung ladders/garage-door.rung 2>/dev/null | grep -E '^(Reading|Opening|Folding|A changed line)'
	@echo "10,000 lines of Structured Text in 102 POUs:"; GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-blocks.rung ladders/garage-door.rung line 2>/dev/null | grep -E '^(Reading|Opening|A changed line)'
	@echo "A chart of 1,000 steps:"; GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-chart.rung ladders/garage-door.rung 2>/dev/null | grep -E '^(Reading|Opening|Scrolling|A step)'
	@echo "300 networks of 6 boxes:"; GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas BUILD=$(BUILD) /usr/bin/python3 tests/editor/person/desk.py $< $(BUILD)/bench-networks.rung ladders/garage-door.rung 2>/dev/null | grep -E '^(Reading|Opening|Scrolling|A network)'
.PHONY: editor-tests bench-editor
# ---- end of the editor ----

# ---- golden cases ----
golden: $(BUILD)/ladder ## compare every case of tests/golden byte by byte
	LADDER=$(BUILD)/ladder prove tests/golden.t
bless: $(BUILD)/ladder ## rewrite the expected files of CASE=name and show the difference
	@LADDER=$(BUILD)/ladder perl tests/golden.t --bless $(CASE)
.PHONY: golden bless
# ---- end of golden cases ----

# ---- second evaluator, fuzz targets, exhaustion, house checks ----
# Programs and scripts that print TAP; `check` runs both lists.
BIN       := $(BUILD)/tests/bin
FUZZ      := read st fbd plcopen code script scenario iomap retain classic ldmicro openplc link record serial peer
WALKER    := $(call obj,$(wildcard tests/walker/*.c))
RANDOM_O  := $(call obj,$(wildcard tests/walker/random*.c tests/walker/words*.c))
TESTS_BIN := $(addprefix $(BIN)/,differential classic_differential sfc_differential st_differential still_differential sfc_ladder sfc_trace members iec_cases exhaustion saving storing disks wear overruns trials $(FUZZ:%=fuzz_%))
TESTS_SH  := tests/floors.sh tests/headers.sh tests/quiet.sh tests/banned.pl tests/pathological.t
HOUSE     := tests/floors.sh tests/headers.sh tests/quiet.sh tests/banned.pl

$(addprefix $(BUILD)/,unit/trial/tests unit/scan/tests tests/editor/draw/tests tests/editor/live/tests tests/editor/sim/tests): $(RANDOM_O)
$(BIN)/differential: $(BUILD)/tests/differential.o $(WALKER)
$(BIN)/sfc_differential: $(BUILD)/tests/sfc_differential.o $(WALKER)
$(BIN)/sfc_trace: $(BUILD)/tests/sfc_trace.o $(WALKER)
$(BIN)/st_differential: $(BUILD)/tests/st_differential.o $(call obj,$(wildcard tests/st/*.c)) $(WALKER)
$(BIN)/sfc_ladder: $(BUILD)/tests/sfc_ladder.o $(RANDOM_O)
$(BIN)/members: $(BUILD)/tests/members.o $(RANDOM_O)
$(BIN)/still_differential: $(BUILD)/tests/still_differential.o $(RANDOM_O)
$(BIN)/iec_cases: $(BUILD)/tests/iec_cases.o
$(BIN)/exhaustion: $(BUILD)/tests/exhaustion.o
$(BIN)/exhaustion: WRAP := -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=aligned_alloc,--wrap=free,--wrap=mmap64,--wrap=munmap
$(BIN)/saving: $(BUILD)/tests/saving.o
$(BIN)/saving: WRAP := -Wl,--wrap=write,--wrap=fsync,--wrap=rename
$(BIN)/storing: $(call obj,tests/storing.c runtime/ladderd/store_file.c runtime/ladderd/disk.c)
$(BIN)/disks: $(call obj,tests/disks.c $(addprefix runtime/ladderd/,store_file.c disk.c journal.c alarm_store.c ends.c conf.c password.c slots.c) $(addprefix runtime/online/,stored.c event.c alarms.c wire.c))
$(BIN)/disks: WRAP := $(patsubst %,-Wl$(comma)--wrap=%,open open64 mkstemp mkstemp64 fsync fdatasync ftruncate ftruncate64 rename read write pread pread64 pwrite pwrite64)
$(BIN)/wear: $(call obj,tests/wear.c $(addprefix runtime/ladderd/,store_thread.c store_file.c disk.c))
$(BIN)/wear: WRAP := -pthread $(patsubst %,-Wl$(comma)--wrap=%,clock_gettime poll fdatasync pwrite pwrite64)
$(BIN)/overruns: $(call obj,tests/overruns.c $(addprefix runtime/ladderd/,cycle.c conf_none.c guarded_none.c store_none.c stats.c wall.c) $(HAL_CORE) hal/gpiod_none.c)
$(BIN)/overruns: WRAP := $(patsubst %,-Wl$(comma)--wrap=%,clock_gettime clock_nanosleep)
$(BIN)/trials: $(call obj,tests/trials.c $(addprefix runtime/ladderd/,cycle.c download.c guarded_none.c store_none.c stats.c wall.c) $(addprefix runtime/online/,event.c wire.c stored.c) $(HAL_CORE) hal/gpiod_none.c)
$(BIN)/trials: WRAP := -Wl,--gc-sections $(patsubst %,-Wl$(comma)--wrap=%,clock_gettime clock_nanosleep)
$(BIN)/storing: WRAP := -Wl,--wrap=pwrite,--wrap=pwrite64,--wrap=fsync,--wrap=fdatasync,--wrap=rename,--wrap=unlink
# A second evaluator for ClassicLadder projects, to compare with the import.
CLASSIC_O := $(call obj,$(wildcard tests/classic/engine*.c) tests/classic/own_read.c tests/classic/run.c)
$(BIN)/classic_trace: $(BUILD)/tests/classic/classic_trace.o $(CLASSIC_O) $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
CLASSIC_RANDOM := $(call obj,tests/classic/random_project.c tests/classic/random_expression.c) $(RANDOM_O)
$(BIN)/classic_random: $(BUILD)/tests/classic/classic_random.o $(CLASSIC_RANDOM) $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
$(BIN)/classic_differential: $(BUILD)/tests/classic_differential.o $(CLASSIC_O) $(CLASSIC_RANDOM)
# Random ladders that use only what ClassicLadder has.
$(BIN)/ladder_random: $(call obj,$(wildcard tests/classic/ladder_*.c) tests/walker/random.c tests/walker/random_print.c)
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^
tests: $(BIN)/classic_trace $(BIN)/classic_random $(BIN)/ladder_random
FUZZ_WITH := $(BUILD)/tests/fuzz/expect.o $(BUILD)/tests/fuzz/replay.o $(RANDOM_O)
$(FUZZ:%=$(BIN)/fuzz_%): $(BIN)/fuzz_%: $(BUILD)/tests/fuzz/fuzz_%.o $(FUZZ_WITH)
$(BIN)/fuzz_st: $(BUILD)/tests/st/st_random.o
$(BIN)/fuzz_script $(BIN)/fuzz_scenario: $(BUILD)/tests/fuzz/sandbox.o
$(BIN)/fuzz_iomap: $(call obj,$(HAL_CORE) hal/gpiod_none.c)
PEER_PLAIN := $(addprefix runtime/peer/,datagram.c inbox.c outbox.c)
$(BIN)/fuzz_peer: $(call obj,$(PEER_PLAIN) runtime/online/wire.c runtime/online/service.c)
$(BIN)/fuzz_link $(BIN)/fuzz_serial: $(filter-out %/finder_avahi.o,$(ONLINE))
$(TESTS_BIN): $(BUILD)/libladder.a
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(LDFLAGS) $(WRAP) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(XML_LIB) -lm

house: $(BUILD)/libladder.a $(DRIVERS) ## check the rules of the house: floors, headers, quiet, banned
	BUILD=$(BUILD) CROSS=$(CROSS) CC='$(CC)' prove -e '' $(HOUSE)
differential: $(BIN)/differential ## engine and walker run 20,000 random programs
	$<
check-long: $(BIN)/differential ## the same with new seeds, until it is stopped
	$< --long
pathological: $(BUILD)/ladder $(BUILD)/ladderd ## test bad input
	BUILD=$(BUILD) prove -e '' tests/pathological.t
# With clang's libFuzzer: make fuzz TARGET=read SECONDS=600
TARGET  ?= read
SECONDS ?= 60
FUZZ_CC ?= clang
FUZZ_FLAGS := -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined
fuzz: $(BIN)/fuzz_$(TARGET) ## fuzz one reader with clang: TARGET=read|st|fbd|plcopen|code|script|scenario|iomap|retain|classic|ldmicro|openplc|link|record|serial SECONDS=60
	@mkdir -p $(BUILD)/fuzz/$(TARGET)
	$(BIN)/fuzz_$(TARGET) --write $(BUILD)/fuzz/$(TARGET) >/dev/null
	$(FUZZ_CC) $(STD) $(CPPFLAGS) $(if $(XML_LIB),$(shell $(PKG_CONFIG) --cflags libxml-2.0)) $(FUZZ_FLAGS) -o $(BUILD)/fuzz/fuzz_$(TARGET) tests/fuzz/fuzz_$(TARGET).c tests/fuzz/expect.c \
	  $(if $(filter st,$(TARGET)),tests/st/st_random.c tests/walker/random.c $(filter-out tests/walker/random_sfc%,$(wildcard tests/walker/random_*.c)) $(wildcard tests/walker/words*.c)) $(if $(filter script scenario,$(TARGET)),tests/fuzz/sandbox.c) $(if $(filter iomap,$(TARGET)),$(HAL_CORE) hal/gpiod_none.c) $(if $(filter peer,$(TARGET)),$(PEER_PLAIN) runtime/online/wire.c runtime/online/service.c) $(if $(filter link serial,$(TARGET)),$(filter-out %/finder_avahi.c,$(wildcard runtime/online/*.c))) $(ENGINE) $(XML_LIB) -lm
	$(BUILD)/fuzz/fuzz_$(TARGET) -max_total_time=$(SECONDS) -timeout=25 -max_len=20000 -artifact_prefix=$(BUILD)/fuzz/ $(BUILD)/fuzz/$(TARGET)
.PHONY: house differential check-long pathological fuzz
# ---- end of second evaluator … house checks ----

# ---- ARM, by user-mode emulation ----
# The programs of tests/arm.sh, for each ARM with an installed compiler.
CROSS_arm64 := aarch64-linux-gnu-
CROSS_armhf := arm-linux-gnueabihf-
ARM := $(foreach a,arm64 armhf,$(if $(shell command -v $(CROSS_$a)gcc),$a))
arm: $(ARM:%=arm-%) ## the tests of the engine for arm64 and armhf, in build/arm64/ and build/armhf/
$(ARM:%=arm-%): arm-%:
	$(MAKE) BUILD=$(BUILD)/$* CROSS=$(CROSS_$*) STATIC=1 HAL=uapi CFLAGS='$(filter-out -g,$(CFLAGS))' arm-programs
$(BUILD)/tests/ladder_batch: $(BUILD)/tests/ladder_batch.o $(filter-out %/main.o,$(LADDER)) $(DRIVERS) $(BUILD)/libonline.a $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(GPIO_LIB) $(AVAHI_LIB) $(XML_LIB) -lm
arm-programs: $(UNIT) $(BIN)/differential $(BIN)/iec_cases $(BUILD)/tests/ladder_batch $(BUILD)/replay
.PHONY: arm arm-programs $(ARM:%=arm-%)
# ---- end of ARM ----

# ---- guest: the suite that runs on emulated kernels ----
# All programs are static, because a guest has no libraries. ladderd-count is ladderd that counts ioctls.
GUEST     := tests/targets/guest
GUEST_LD   = $(LEAN_LD) $(LDFLAGS) $(if $(findstring -static,$(LDFLAGS)),,-static)
guest: $(BUILD)/guest $(BUILD)/replay $(BUILD)/ladderd-count ## the guest suite, replay and ladderd-count, for the target
# With a desk of its own, for boards that cannot run `ladder`.
$(BUILD)/guest: $(call obj,$(wildcard $(GUEST)/*.c) $(addprefix runtime/online/,desk.c port.c send.c serial.c service.c status.c stored.c stream.c sums.c wire.c)) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(GUEST_LD) -o $@ $^
$(BUILD)/power: $(call obj,$(GUEST)/power/power.c runtime/online/event.c runtime/online/status.c runtime/online/stored.c runtime/online/wire.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(GUEST_LD) -o $@ $^
$(BUILD)/replay: $(call obj,$(GUEST)/replay/replay.c $(CORE))
	$(CC) $(CFLAGS) $(GUEST_LD) -o $@ $^ -lm
$(BUILD)/ladderd-count: $(LADDERD) $(DRIVERS) $(call obj,$(GUEST)/count/count_ioctl.c) $(if $(filter 1,$(SMALL)),$(ONLINE_SERIAL),$(BUILD)/libonline.a) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(GUEST_LD) $(PRINT) $(THREADS) -Wl,--wrap=ioctl,--wrap=__ioctl_time64 -o $@ $^ $(GPIO_LIB) $(CRYPT_LIB) -lm

# The cases for them, made on this machine: build/cases/.
CASES     := $(BUILD)/cases
PROGRAMS  ?= 1000
$(BUILD)/make_cases: $(call obj,$(wildcard $(GUEST)/cases/*.c) $(wildcard tests/walker/random*.c tests/walker/words*.c) $(HAL_CORE) hal/gpiod_none.c) $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
cases: $(CASES)/stamp ## programs, maps, plans, bad images and programs.bundle for the guest suite
$(CASES)/stamp: $(BUILD)/make_cases $(BUILD)/ladder $(wildcard ladders/*.rung ladders/*.scn ladders/boards/*.io $(GUEST)/programs/* $(GUEST)/cases/make.sh)
	@$(GUEST)/cases/make.sh $(BUILD) $(CASES) $(PROGRAMS)
	@touch $@
.PHONY: guest cases
# ---- end of guest ----

# ---- targets: the runtime on real kernels, in emulators ----
# tests/targets/ has a script for each target. A missing package is reported.
VEHICLES  ?= uml field m3 riscv ast2600 armhf arm64 power
AT_ONCE   ?= 1
check-targets: ## the guest suite on emulated boards: VEHICLES="uml field m3 riscv ast2600 armhf arm64 power" AT_ONCE=1
	@rm -f $(VEHICLES:%=$(BUILD)/targets/%/result); status=0; \
	  BUILD=$(BUILD) prove $(if $(filter 1,$(AT_ONCE)),-v) -j$(AT_ONCE) -e '' $(VEHICLES:%=tests/targets/%) || status=$$?; \
	  [ $$status -eq 0 ] || grep -a '^not ok' $(VEHICLES:%=$(BUILD)/targets/%/console) /dev/null; \
	  cat $(VEHICLES:%=$(BUILD)/targets/%/result); exit $$status
sizes: ## the size of the runtime for small boards, and of each room
	@BUILD=$(BUILD) tests/targets/sizes
.PHONY: check-targets sizes
# ---- end of targets ----

# ---- board: files that a board needs besides ladderd, and its figures ----
VERSION     := $(shell sed -n 's/.*LADDER_VERSION "\(.*\)"/\1/p' runtime/engine/base/version.h)
# /etc/ladder/active names the running program. `ladder push` rewrites it, so an existing one stays.
udevdir     ?= /lib/udev/rules.d
sysusersdir ?= /usr/lib/sysusers.d
install: install-board
install-board: install-ladderd
	install -d $(DESTDIR)/etc/ladder $(DESTDIR)$(udevdir) $(DESTDIR)$(sysusersdir)
	install -m 755 packaging/ladderd-run $(DESTDIR)$(prefix)/bin/ladderd-run
	install -m 644 packaging/60-gpio.rules $(DESTDIR)$(udevdir)/60-ladderd-gpio.rules
	install -m 644 packaging/ladderd.sysusers $(DESTDIR)$(sysusersdir)/ladderd.conf
	install -d $(DESTDIR)/etc/avahi/services
	sed 's/@VERSION@/$(VERSION)/' packaging/ladder.service >$(DESTDIR)/etc/avahi/services/ladder.service
	test -e $(DESTDIR)/etc/ladder/active || install -m 644 packaging/ladderd.active $(DESTDIR)/etc/ladder/active
push-tests: $(BUILD)/ladder $(BUILD)/ladderd ## test ladder push with a real sshd on loopback
	BUILD=$(BUILD) prove tests/push.t
# `ladder` with the fake chips of the HAL tests, for `ladder io`.
$(HAL_TEST)/ladder_%: $(LADDER) $(HAL_TEST)/%/io_fake.o $(BUILD)/libonline.a $(BUILD)/libladder.a Makefile
	$(CC) $(CFLAGS) $(LDFLAGS) $(WRAP) -Wl,--wrap=opendir,--wrap=fopen,--wrap=fopen64,--wrap=iomap_read -o $@ $(filter %.o,$^) $(filter %.a,$^) $(AVAHI_LIB) $(XML_LIB) -lm
$(HAL_TEST)/ladder_v1: $(call HAL_FAKE,v1,gpiod_v1)
$(HAL_TEST)/ladder_v2: $(call HAL_FAKE,v2,gpiod_v2)
$(HAL_TEST)/ladder_uapi: $(call HAL_FAKE,uapi,gpio_uapi)
$(HAL_TEST)/ladder_uapi: WRAP := -Wl,--wrap=open,--wrap=open64,--wrap=close,--wrap=ioctl
tests: $(HAL_KINDS:%=$(HAL_TEST)/ladder_%)
# Packages of Debian, from a copy of the tree; the editor for the architecture of this machine.
DEB_ARCH ?= amd64 arm64 armhf
deb: ## packages of Debian in build/deb/: rungboard-runtime and rungboard-editor for amd64, arm64 and armhf
	packaging/deb.sh $(BUILD)/deb $(DEB_ARCH)
# A second time, for the hashes; then into a clean system, which mmdebstrap loads once. It boots without a
# network, so it has the libraries that the runtime needs.
DEB_ROOT = openssh-server,systemd-sysv,udev,libavahi-client3,libmodbus5,libxml2
check-deb: root = $(BUILD)/deb/root-$(firstword $(shell echo $(DEB_ROOT) | cksum)).tar
check-deb: deb $(BUILD)/ladder ## build the packages twice, compare, lintian, boot a clean system, install, connect over ssh from the editor, upgrade, remove; needs root and a network
	packaging/deb.sh $(BUILD)/deb/again $(DEB_ARCH)
	test -f $(root) || mmdebstrap --variant=minbase --include=$(DEB_ROOT) bookworm $(root)
	BUILD=$(BUILD) DEB_ARCH='$(DEB_ARCH)' tests/deb/check.py $(BUILD)/deb $(BUILD)/deb/again $(root)
.PHONY: deb check-deb
bench-rt: $(BUILD)/ladderd ## measure how late ladderd wakes up, compared with cyclictest
	@BUILD=$(BUILD) tests/bench/rt.sh
bench-online: $(BUILD)/ladder $(BUILD)/ladderd $(BUILD)/tests/online/ladder-attach ## measure the link to desks: reading, watching, downloads
	@BUILD=$(BUILD) tests/bench/online.py
bench-field: $(BUILD)/ladderd $(BUILD)/ladder-modbus ## measure ladder-modbus: a serial line, 10,000 registers over TCP, reaction, faults of a wire; it fails beyond its limits
	@BUILD=$(BUILD) tests/bench/field.py
bench-jitter: $(BUILD)/ladder $(BUILD)/ladderd $(BUILD)/tests/online/ladder-attach ## two minutes: how late scans begin while eight desks watch and all processors are busy; as root it fails beyond 1 ms
	@BUILD=$(BUILD) JITTER=60 /usr/bin/python3 tests/online/stress.py test_desks_and_busy_processors_delay_no_scan
.PHONY: install-board push-tests bench-rt bench-online bench-field bench-jitter
# ---- end of board ----

# ---- small ----
# The builds for small boards, for this machine: with all words, with WORDS=core, and that with LINK=serial.
small: ## ladderd and replay of SMALL=1, for this machine: build/small/, build/small-core/ and build/small-serial/
	$(MAKE) BUILD=$(BUILD)/small SMALL=1 HAL=uapi $(BUILD)/small/ladderd $(BUILD)/small/replay
	$(MAKE) BUILD=$(BUILD)/small-core SMALL=1 WORDS=core HAL=uapi $(BUILD)/small-core/ladderd
	$(MAKE) BUILD=$(BUILD)/small-serial SMALL=1 LINK=serial WORDS=core HAL=uapi $(BUILD)/small-serial/ladderd
.PHONY: small
# ---- end of small ----

# ---- everything ----
# One list for prove. A second build with sanitizers runs the tests that read and run files. Its
# char is unsigned, as on ARM.
SANITIZE := -O1 -g -funsigned-char -fsanitize=address,undefined -fno-sanitize-recover=undefined
ASAN     := $(BUILD)/asan
ASAN_RUN := $(UNIT:$(BUILD)/%=$(ASAN)/%) $(HAL_TESTS:$(BUILD)/%=$(ASAN)/%) \
            $(filter-out %/exhaustion,$(TESTS_BIN:$(BUILD)/%=$(ASAN)/%)) $(EDITOR_TESTS_PLAIN:$(BUILD)/%=$(ASAN)/%)
TESTS_T  := $(wildcard tests/*.t tests/hal/*.t) tests/online/link.py tests/online/gateways.py tests/online/peers.py tests/online/stress.py tests/online/sick_disk.py tests/online/quiet_scan.py tests/online/watchdog.py tests/online/serial_line.py tests/online/small_line.py tests/compilers.sh tests/pages.sh $(EDITOR_PERSON)
BUILT    := $(UNIT) $(HAL_TESTS) $(TESTS_BIN) $(EDITOR_TESTS)
TESTS_T  += tests/modbus/field.py tests/modbus/ways_out.py tests/modbus/plant.py

tests: all man $(BUILT) $(EDITOR_FAKE) $(EDITOR_WALK) $(HAL_DAEMONS) $(BUILD)/tests/online/ladder-attach
asan: ## the same with address and undefined-behaviour sanitizers, in build/asan/
	$(MAKE) BUILD=$(ASAN) CFLAGS='$(SANITIZE)' LDFLAGS='$(SANITIZE)' \
	  CPPFLAGS='$(CPPFLAGS) -DDIFFERENTIAL_COUNT=1000' $(ASAN_RUN) $(ASAN)/ladder $(ASAN)/ladderd
check-plant: all ## the cement plant on two boards, with modules that pymodbus simulates: four minutes
	@BUILD=$(BUILD) PLANT=1 /usr/bin/python3 tests/modbus/plant.py
.PHONY: check-plant
TSAN     := $(BUILD)/tsan
TSAN_RUN := $(addprefix tests/online/,link.py gateways.py peers.py stress.py sick_disk.py quiet_scan.py watchdog.py) tests/modbus/field.py
tsan: ## ladderd and its gateways with the sanitizer of threads, in build/tsan/, and the tests of the link; it fails if a race is reported
	$(MAKE) BUILD=$(TSAN) CFLAGS='-O1 -g -fsanitize=thread' LDFLAGS=-fsanitize=thread tsan-run
tsan-run: $(BUILD)/ladder $(BUILD)/ladderd $(BUILD)/ladder-modbus $(BUILD)/ladder-peer $(BUILD)/ladder-guard $(BUILD)/tests/online/ladder-attach $(BUILD)/tests/bin/ladder_random $(SICK_DISK) $(HAL_TEST)/ladderd_uapi $(HAL_TEST)/ladderd_v2
	@races=$$(mktemp -d) && chmod 777 $$races; status=0; \
	  BUILD=$(BUILD) LADDER=$(BUILD)/ladder TSAN_OPTIONS="log_path=$$races/race:exitcode=0" prove -e '' $(TSAN_RUN) || status=1; \
	  cat $$races/* 2>/dev/null && status=1; rm -r $$races; exit $$status
.PHONY: tsan tsan-run
asan-editor: ## the editor and its tests with sanitizers: in process, and as a person; ten minutes
	$(MAKE) BUILD=$(ASAN) CFLAGS='$(SANITIZE)' LDFLAGS='$(SANITIZE)' asan-editor-run
asan-editor-run: $(EDITOR_TESTS) $(EDITOR_FAKE) all
	BUILD=$(BUILD) G_SLICE=always-malloc ASAN_OPTIONS=detect_leaks=0 PATIENCE=180 \
	  prove -j$$(nproc) -e '' $(EDITOR_TESTS) $(EDITOR_PERSON)
# The editor ends cleanly at SIGTERM, so leaks are reported. Libraries have no frame pointers, so
# unwinding each allocation is slow: it takes hours. tests/editor/leaks.supp lists leaks of libraries.
leaks-editor: ## the same for leaks; PERSON=tests/editor/person/tree.py: only these scripts
	$(MAKE) BUILD=$(ASAN) CFLAGS='$(SANITIZE)' LDFLAGS='$(SANITIZE)' leaks-editor-run
leaks-editor-run: $(EDITOR_TESTS) $(EDITOR_FAKE) all
	BUILD=$(BUILD) G_SLICE=always-malloc ASAN_OPTIONS=fast_unwind_on_malloc=0 PATIENCE=600 \
	  LSAN_OPTIONS=suppressions=tests/editor/leaks.supp:print_suppressions=0 \
	  prove -j$$(nproc) -e '' $(if $(PERSON),$(PERSON),$(EDITOR_TESTS) $(EDITOR_PERSON))
# About two minutes a test. Suppressions of the toolkits are used if they are installed.
VALGRIND := valgrind -q --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
            --error-exitcode=9 --num-callers=60 $(addprefix --suppressions=,$(wildcard \
            /usr/share/glib-2.0/valgrind/glib.supp /usr/share/gtk-4.0/valgrind/gtk.supp) tests/editor/valgrind.supp)
valgrind-editor: all ## scripts of the editor under valgrind: lost and uninitialised memory; PERSON=… as above
	BUILD=$(BUILD) GSETTINGS_SCHEMA_DIR=$(BUILD)/schemas G_SLICE=always-malloc PATIENCE=600 WRAPPER='$(VALGRIND)' \
	  prove -e '' $(if $(PERSON),$(PERSON),$(EDITOR_PERSON))
# Scripts that use the editor mostly wait for it. So more tests run at once than there are processors, and each
# script runs beside a test that computes. The longest tests are first.
JOBS     ?= $$(($$(nproc) * 2))
LONGEST  := tests/arm.sh $(BIN)/sfc_differential $(BIN)/differential tests/push.t tests/compilers.sh
COMPUTING := $(sort $(filter-out $(LONGEST) $(EDITOR_PERSON),$(TESTS_T) $(TESTS_SH) tests/small.sh)) \
            $(TESTS_BIN:$(BUILD)/%=$(ASAN)/%) $(filter-out $(LONGEST) $(BIN)/exhaustion,$(TESTS_BIN)) $(BIN)/exhaustion
in_turn   = $(subst |, ,$(join $(addsuffix |,$(1)),$(2)))
IN_ORDER  = $(LONGEST) $(call in_turn,$(EDITOR_PERSON),$(filter-out $(ASAN)/%/exhaustion,$(COMPUTING))) \
            $(filter-out $(TESTS_BIN),$(BUILT)) $(filter-out $(COMPUTING),$(ASAN_RUN))
check: tests asan arm small cases ## build, then run every test; failures of scripts of the editor are printed again at the end
	rm -rf $(BUILD)/failed
	BUILD=$(BUILD) LADDER=$(BUILD)/ladder CROSS=$(CROSS) CC='$(CC)' prove -j$(JOBS) -e '' $(IN_ORDER) || \
	  { head -vn 9 $(BUILD)/failed/* 2>/dev/null; exit 1; }
# The tests for a change of one room. A script with TEST.quick = 'ROOM' has a test for that room; for other
# rooms those of editor-gtk/window run.
ifneq ($(filter quick,$(MAKECMDGOALS)),)
QUICK    := $(patsubst %/,%,$(or $(ROOM),$(shell tests/changed.sh)))
$(foreach r,$(QUICK),$(if $(wildcard $r/),,$(error ROOM=$r: no such folder; for example editor-gtk/live or runtime/engine/scan)))
QUICK_IN := $(patsubst runtime/engine/%,runtime/%,$(QUICK))
QUICK_IN := $(patsubst editor-gtk/%,$(BUILD)/tests/editor/%,$(QUICK_IN:runtime/%=$(BUILD)/unit/%))
QUICK_TESTS := $(sort $(foreach d,$(QUICK_IN),$(filter $d/test_%,$(UNIT) $(EDITOR_TESTS))) $(if $(filter hal,$(QUICK)),$(HAL_TESTS)))
with_test = $(if $(EDITOR),$(shell grep -lE "\.quick = '($(subst $() ,|,$(strip $(1))))'" $(EDITOR_PERSON)))
JOURNEYS := $(or $(call with_test,$(QUICK)),$(call with_test,editor-gtk/window))
QUICK_ENV = BUILD=$(BUILD) LADDER=$(BUILD)/ladder CROSS=$(CROSS) CC='$(CC)' QUICK='$(or $(QUICK),editor-gtk/window)'
endif
quick: all $(QUICK_TESTS) $(EDITOR_WALK) ## test a change of one room in a minute: ROOM=editor-gtk/live, or the rooms with changes in git
	@echo "quick: $(or $(QUICK),no room)"
	$(QUICK_ENV) prove -j$(JOBS) -e '' $(JOURNEYS) tests/golden.t tests/floors.sh tests/quiet.sh tests/banned.pl $(QUICK_TESTS)
$(BUILD)/tests/bench/record $(BUILD)/tests/bench/carry: %: %.o $(BUILD)/libladder.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lm
mutants: tests ## put one fault a room into a copy and see whether the tests find it: MUTANTS="hal canvas" for some
	BUILD=$(BUILD) CC='$(CC)' tests/mutants.pl $(MUTANTS)
# Tests may fail in this slow build; the table is of what they have run.
COVERAGE := $(BUILD)/coverage
coverage: ## the share of lines and branches that the tests run, for each folder: with gcov and gcovr, in build/coverage/; an hour
	$(MAKE) BUILD=$(COVERAGE) CFLAGS='-O0 -g --coverage' LDFLAGS=--coverage coverage-run
# Some programs run as other users, who may write only to a file that is there.
coverage-run: tests cases
	find $(BUILD) -name '*.gcno' | sed 's/gcno$$/gcda/' | xargs touch
	find $(BUILD) -name '*.gcda' | xargs chmod a+rw
	-BUILD=$(BUILD) LADDER=$(BUILD)/ladder prove -j$(JOBS) -e '' $(sort $(filter-out tests/%.sh,$(TESTS_T)) $(BUILT))
	find $(BUILD) -name '*.gcda' -empty -delete
	tests/coverage.pl $(BUILD)
.PHONY: coverage coverage-run
bench: $(BUILD)/ladder $(BUILD)/ladderd $(BUILD)/tests/bench/record ## speed, load time and size, as a table
	@BUILD=$(BUILD) CC='$(CC)' tests/bench/bench.sh
.SECONDARY:
.PHONY: mutants tests asan asan-editor asan-editor-run leaks-editor leaks-editor-run valgrind-editor check quick bench
# ---- end of everything ----

clean: ## remove everything that was built
	rm -rf $(BUILD)
help: ## list the targets
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "  %-14s %s\n", $$1, $$2}' Makefile
.PHONY: all unit words clean help
