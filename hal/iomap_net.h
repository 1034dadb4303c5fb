/* SPDX-License-Identifier: MIT
 *
 * iomap_net - what the reader of points needs of the reader of buses and modules, and the words that both
 * read. Private to iomap_net.c and iomap_channel.c.
 */
#ifndef HAL_IOMAP_NET_H
#define HAL_IOMAP_NET_H

#include "hal/iomap_read.h"

#include <string.h>

#define SECOND       INT64_C(1000000000)
#define TIME_MOST    (3600 * SECOND)
#define DI_BYTES     3u  /* of a module, in %XI                              */
#define DQ_BYTES     2u  /* in %XQ                                           */
#define ANALOG_BYTES 16u /* in %XAI and in %XAQ                              */

/* A type of module: how many inputs and outputs, and where they begin. */
struct module_type {
	const char *name;
	uint16_t count[4], first[4]; /* by table - 1: DQ, DI, AI, AQ            */
};

struct net_reader {
	struct io_net net;
	struct module_type *module; /* of MODULE lines                          */
	int module_count;
};

/* NAME or NAME=VALUE. */
struct option_word {
	struct map_word word;
	size_t name;        /* bytes of the name                              */
	const char *value;  /* NULL: none                                     */
	size_t len;
};

bool next_option(struct reader *reader, struct option_word *out);
bool option_is(const struct option_word *option, const char *name);
static inline bool same_text(const char *a, const char *b)
{
	return a && b && strcmp(a, b) == 0;
}
/** read_order - big or little. */
bool read_order(const struct option_word *option, bool *swapped);
/** read_count - a decimal number up to @most, and nothing else. */
bool read_count(const char *text, size_t len, uint32_t most, uint32_t *out);
/** read_time - above 0, at most TIME_MOST. */
bool read_time(const char *text, size_t len, int64_t *ns);
/** find_dots - the ".." in a text; NULL: it has none. */
const char *find_dots(const char *text, size_t len);

/** net_of - makes it with the first line that needs it. NULL: no memory. */
struct net_reader *net_of(struct reader *reader);
/** find_bus - its number; -1: there is none of this name. */
int find_bus(const struct io_net *net, const char *text, size_t len);
/** only_peer_bus - the bus of lines that name none; -1: there is none of peers, or several. */
int only_peer_bus(const struct io_net *net);
enum { IO_PEER_BOARD = 63 }; /* bytes of the name of a board that a datagram carries */
/** peer_bus_needed - what a line without one needs: the option, or a BUS line if there is none. A constant text. */
const char *peer_bus_needed(const struct io_net *net);
/** peer_board_fits - can a datagram carry this name of a board? False, and an error at @at. */
bool peer_board_fits(struct reader *reader, const struct map_word *at, const char *text, size_t len);
/** find_ask - its number, made with its first line; @channel and @output are of the present line. -1: no memory. */
int find_ask(struct reader *reader, const char *text, size_t len);
const struct module_type *find_module(const struct net_reader *net, const char *text, size_t len);

/** check_qualities - an error for each quality of an input that the map does not have. */
void check_qualities(struct reader *reader);

/* Words of a map, and what they stand for. */
const char *bus_word(enum io_bus_kind kind);
const char *table_word(enum io_table table);
enum io_table table_of(const struct option_word *option);
/** is_of_bits - coils and discrete inputs. */
bool is_of_bits(enum io_table table);
#endif
