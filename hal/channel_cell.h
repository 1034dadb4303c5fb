/* SPDX-License-Identifier: MIT
 *
 * channel_cell - what channels.c (in a scan) and channels_run.c (threads, opening) share. Private to both.
 *
 * Who writes what: a thread or a gateway writes `read` … `failures`; the scan writes `wanted`, `serial`, `asks`
 * and `quality`. All of these are atomic, none is locked. A reader may see a new value with the time of the one
 * before: it is then a little older than it is.
 */
#ifndef HAL_CHANNEL_CELL_H
#define HAL_CHANNEL_CELL_H

#include "hal/device.h"

#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

struct cell {
	struct io_point point;     /* copies: a thread may outlive the map     */
	struct io_channel channel;
	int number;                /* in the map                               */
	int *of, of_count;         /* quality: the cells whose worst it tells   */
	const struct device_driver *driver; /* NULL: a gateway                 */
	struct device device;      /* of its thread, once it runs              */
	struct cell *twin;         /* in the other map: the same channel       */
	double safe;               /* raw                                      */
	int64_t safe_number;       /* likewise, for the file                   */
	_Atomic int file;          /* of an output; -1: not open. It is never closed before the end, so that
				    * a signal handler writes to no other file */

	_Atomic uint64_t read;     /* a double, or of a gateway of the type channel->raw */
	_Atomic int64_t read_ns;
	_Atomic uint32_t goods;    /* 0: it has no value                       */
	_Atomic uint32_t failures; /* in a row                                 */
	_Atomic uint32_t tries;

	_Atomic uint64_t wanted;   /* raw, a double                            */
	_Atomic uint32_t serial;   /* of its changes                           */
	_Atomic uint32_t asks;     /* how often it was to be written           */
	_Atomic int64_t writing_ns; /* since when a thread writes; 0: none does */
	_Atomic bool leaves;       /* the other map runs, and does not have it */
	_Atomic int quality;

	/* Of the scan. */
	union iec_value value;     /* in the image                             */
	double smooth;
	int64_t smooth_ns, asked_ns;
	bool is_smooth, is_asked, bit;
	bool is_told;              /* of channels_trace(): the value it gave last */
	int told_quality;
	union iec_value told;

	/* Of its thread. */
	int64_t next_ns, found_ns;
	_Atomic uint32_t written;  /* the number of the ask                    */
};

#define RUNNERS 64 /* threads at most; more devices share them */

struct runner {
	struct channels *of;
	int number, wake;          /* an eventfd                               */
	char home[DEVICE_PATH];
};

/* One block of memory with an arena of its own, so that a thread that hangs in a read may end later than the
 * map: the last one frees it. */
struct channels {
	struct arena arena;
	const char *file, *sys;    /* file: of the map; borrowed while it is opened */
	struct cell *cell;
	int count;
	int *of_point;             /* the number of the cell of a point; -1    */
	int points;
	struct runner *runner;
	int *runner_of;            /* of each cell; -1: a gateway              */
	int runner_count;
	_Atomic int users;         /* threads, and the one who closes          */
	_Atomic bool ending, active;
	_Atomic int held;
	_Atomic int worst;
	_Atomic int lines;         /* the worst of the lines of chips           */
	uint64_t changes;          /* how often a quality became another one; of the scan */
};

/** channel_number - a value of any type as a number. Scan-safe: yes. */
double channel_number(enum iec_type type, union iec_value value);

/** cell_put - a thread has read, or written. Scan-safe: yes. */
void cell_put(struct cell *cell, uint64_t value, bool good, int64_t now_ns);
/** cell_output - what its thread is to write now. Scan-safe: yes. */
double cell_output(const struct channels *channels, const struct cell *cell);
/** cell_number - a raw value as the number in the file of an output. */
int64_t cell_number(const struct device *device, double raw);
/** cell_write - writes a number to an open file. Scan-safe: yes, also in a signal handler. 0 or -errno. */
int cell_write(const struct cell *cell, int64_t number);
/** cell_write_safe - writes the safe value, unless a thread hangs in a write. Likewise. */
void cell_write_safe(struct cell *cell);
/** channels_wake - the thread of a cell looks for work. Scan-safe: as cell_write(). */
void channels_wake(const struct channels *channels, const struct cell *cell);

static inline uint64_t bits_of(double x)
{
	uint64_t bits;

	memcpy(&bits, &x, sizeof(bits));
	return bits;
}

static inline double double_of(uint64_t bits)
{
	double x;

	memcpy(&x, &bits, sizeof(x));
	return x;
}
#endif
