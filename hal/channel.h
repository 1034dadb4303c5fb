/* SPDX-License-Identifier: MIT
 *
 * channel - how a line of an I/O map gets values that are more than a level of a chip: analog values,
 * and all that a wire or another board serves.
 *
 * hal/iomap_channel.c reads them, hal/channels.c moves the values. One point has one value: a group
 * (`%IW100..106`) and a module are as many points.
 */
#ifndef HAL_CHANNEL_H
#define HAL_CHANNEL_H

#include "hal/iomap.h"

/* ---- buses ---- */

enum io_bus_kind { BUS_MODBUS_RTU, BUS_MODBUS_TCP, BUS_PEER };

/* BUS rs485 modbus-rtu port=/dev/ttyS1 baud=19200 parity=even stop-bits=1 timeout=100ms
 * BUS plant modbus-tcp host=10.0.0.20:502 timeout=300ms
 * BUS yard  peer interface=eth0 group=239.192.20.1:20020
 * The arena of the map owns the strings. */
struct io_bus {
	const char *name;
	enum io_bus_kind kind;
	const char *port;      /* of modbus-rtu: device of the serial line     */
	uint32_t baud;
	char parity;           /* 'N', 'E', 'O'                                */
	uint8_t stop_bits;     /* 1, 2                                         */
	const char *host;      /* of modbus-tcp, and the group of peer; without its port */
	uint16_t tcp_port;     /* likewise: the port                           */
	const char *interface; /* of peer: "eth0"                              */
	int64_t timeout_ns;    /* for an answer                                */
	int text_line, text_column;
};

/* ---- a point ---- */

enum io_unit {
#define UNIT(id, word) UNIT_##id,
#include "hal/units.def"
};
/** io_unit_word - "V"; "" of UNIT_NONE and of no unit at all. Lives for ever. Scan-safe: yes. */
const char *io_unit_word(enum io_unit unit);

enum io_table {
	TABLE_NONE,
#define TABLE_WORD(id, text, of_bits) TABLE_##id,
#include "hal/map_words.def"
};

/* What a device delivers is `raw`. A scaled point has: value_low … value_high in the process image
 * for at_low … at_high of the device, in basic units (V, A, °C, %, Ω) or, with UNIT_NONE, as raw. */
struct io_channel {
	enum iec_type type;    /* in the process image; BOOL for a bit         */
	enum iec_type raw;     /* on the wire; as type, if the map does not say */
	bool scaled;
	double value_low, value_high, at_low, at_high;
	enum io_unit unit;
	bool limited;          /* values outside are a fault, such as a wire that broke */
	double least, most;    /* in `unit`                                    */
	bool switches;         /* an analog value as a bit                     */
	double on_at, off_below; /* in `unit`: TRUE from, FALSE below           */
	int64_t filter_ns;     /* time constant of a first-order low-pass; 0: none */
	int64_t stale_ns;      /* an input without a new value so long is stale  */
	bool substituted;      /* a stale or faulty input gets `substitute`; else it keeps its value */
	union iec_value substitute;
	union iec_value safe;  /* of an output, unless point->hold             */
	int64_t poll_ns;       /* between two reads                            */
	int64_t refresh_ns;    /* longest time between two writes              */
	int ask;               /* moved only when a block of the program asks: its number in the map's
				* list, + 1; 0: by time */

	/* iio: device=ads1115 channel=voltage0; pwm: chip=pwmchip0 channel=0 period=20ms; w1:
	 * sensor=28-000005e2fdc3; hwmon: device=cpu_thermal channel=temp1; peer: from=pump-house
	 * name=Level. */
	const char *device;    /* iio, hwmon: its name; pwm: chip; w1: sensor; peer: from */
	const char *name;      /* iio, hwmon: channel; peer: variable           */
	uint32_t number;       /* pwm: channel                                 */
	int64_t period_ns;     /* pwm                                          */

	/* modbus, module, peer */
	int bus;               /* number in the map's list; -1: none            */
	uint8_t unit_id;       /* 0 … 247                                      */
	enum io_table table;
	uint16_t reg;          /* number of the coil or register, from 0 on      */
	int8_t reg_bit;        /* only this bit of the register; -1: all of it  */
	bool word_swapped;     /* the register of lower number is the lower half */
	bool byte_swapped;     /* … and within a register the first byte          */
	bool has_word_order, has_byte_order; /* its line says so; else its DEVICE line may */
	/* quality of=%AIW0: the worst of the inputs with these bits. A bit is TRUE if all are good; else
	 * the value is an enum hal_quality. */
	struct iec_addr of;
	uint32_t of_bits;

	int module;            /* place of the module, 0 … 15; -1: no module   */
};

/* ---- what others may ask of us ---- */

/* SERVE plc modbus-tcp listen=127.0.0.1:502 unit=1 connections=4
 * SERVE old modbus-rtu port=/dev/ttyS2 baud=19200 unit=5 */
struct io_serve {
	struct io_bus at;      /* name, kind, port …; host and tcp_port: where it listens */
	uint8_t unit_id;
	uint16_t connections;  /* at most, at one time                         */
	uint32_t rate;         /* requests a second, at most, of all            */
};

/* WINDOW plc holding-register=0..9 %MW0 read-write
 * WINDOW plc coil=0..15 %QX0.0 read-only
 * Coil or register number `first` + i is the i-th bit or word from `addr` on. */
struct io_window {
	int serve;             /* number in the list of servers                */
	enum io_table table;
	uint16_t first;
	uint32_t count;        /* coils or registers                           */
	struct iec_addr addr;  /* of the first; a bit or a word                */
	bool writable;
	int text_line, text_column;
};

/* DEVICE plant unit=3 read-registers=50 write-registers=20 gap=0 together word-order=little
 * The most that a device takes in one request, if Modbus allows more. 0: as Modbus allows. */
struct io_takes {
	int bus;
	uint16_t unit_id;      /* 0 … 247                                      */
	uint16_t read_words, write_words, read_bits, write_bits;
	int16_t gap_words;     /* registers that nobody wants and that a read takes along; -1: as usual */
	bool together;         /* function 23 reads and writes in one request  */
	bool word_swapped, byte_swapped; /* of its registers; see struct io_channel */
	int text_line, text_column;
};

/* ask=Meter of points on Modbus: they are read when the block MB_READ of this name asks, or written when
 * MB_WRITE does. For a gateway it is the point behind all points of the map: an output with the number of the
 * request, 0: none; an input with its lower half above and a status below. Both are UDINT. */
struct io_ask {
	const char *name;
	int bus;
	bool writes;
	int text_line, text_column;
};

/* PUBLISH pump-house Level, Running every=100ms bus=yard */
struct io_publish {
	int bus;
	const char *as;        /* the name of this board                       */
	const char *const *name; /* variables                                 */
	int count;
	int64_t every_ns;
	int text_line, text_column;
};

/* All of a map that is no point; iomap.net is NULL if there is none of it. */
struct io_net {
	struct io_bus *bus;
	int bus_count;
	struct io_serve *serve;
	int serve_count;
	struct io_takes *takes;
	int takes_count;
	struct io_ask *ask;
	int ask_count;
	struct io_window *window;
	int window_count;
	struct io_publish *publish;
	int publish_count;
};

#define IO_STALE_NS   1000000000 /* of inputs that do not say stale=       */
#define IO_POLL_NS    100000000  /* … poll=                                */
#define IO_REFRESH_NS 1000000000 /* … refresh=                             */
#define IO_BUSES      16         /* of a map; servers, too                  */

/** io_is_gateway - whether another program serves the point (modbus, module, peer), and not a driver
 * in this one. */
bool io_is_gateway(const struct io_point *point);

struct image;
/** io_ask_find - the block MB_READ or MB_WRITE of @ask: @at gets its place in the memory of the image.
 * Scan-safe: no.   Fails: false: the program has none of this name. */
bool io_ask_find(const struct image *image, const struct io_ask *ask, uint32_t *at);

/** channel_round - the nearest whole number, from a half away from 0: round() of libm, which ladderd would need for
 * nothing else. Scan-safe: yes. */
double channel_round(double x);
/** channel_value - what the process image gets for a raw value
 * @raw: real: in `unit` of the channel; else of the type channel->raw
 * @out: of the type channel->type; numbers that do not fit are cut to the nearest that does
 * Scan-safe: yes.   Fails: false: the value is outside of least … most; @out is set all the same. */
bool channel_value(const struct io_channel *channel, double raw, union iec_value *out);
/** channel_raw - the other way: what the device gets for a value of the process image. Scan-safe: yes. */
double channel_raw(const struct io_channel *channel, union iec_value value);
/** channel_wanted - the same for a gateway: of the type channel->raw. Scan-safe: yes. */
union iec_value channel_wanted(const struct io_channel *channel, union iec_value value);
#endif
