/* SPDX-License-Identifier: MIT
 *
 * link - lets desks see and change what runs: a thread with a socket on this machine, a serial
 * line, or both.
 *
 * It opens no network: desks reach the socket through ssh and ladder-attach. The kernel says
 * who a client is, its groups say what it may do. SMALL=1 has link_none.c instead, and with
 * LINK=serial link_serial.c: the serial line alone, served between two scans, without a thread.
 */
#ifndef LADDERD_LINK_H
#define LADDERD_LINK_H

#include "ladderd/cycle.h"
#include "ladderd/options.h"

struct link;

/* Where downloads go. */
struct link_store {
	struct slots *slots;
	struct conf *conf;
	const struct store_wish *retain;
	struct program *program;       /* that runs; gets an index of its names */
	struct arena *arena;           /* of the index                         */
	const char *map_text;          /* of the map that runs; borrowed       */
	size_t map_len;
	uint32_t record_kb;            /* of the record; 0: none               */
};

/* What goes into the record (scan/recorder.h). */
enum link_note {
	NOTE_START,    /* the program has started, with its retained values   */
	NOTE_SWAP,     /* another program goes on                             */
	NOTE_SCAN,     /* a scan begins; its inputs are read                  */
	NOTE_INTERRUPTING, /* a task is interrupted; inputs are not read yet  */
	NOTE_INTERRUPT,    /* … now they are                                  */
	NOTE_SCANNED,
	NOTE_STOP,     /* ordered by a person                                 */
	NOTE_FAULT,
};

/**
 * link_open - makes the socket, opens the serial line
 * @options: --link: the socket, one that no process listens at is replaced; --serial: the line;
 *           --groups: the file that gives the groups their numbers; borrowed
 * @store: copied; without a folder of slots, downloads are refused
 * @cycle: with its resource and identity; must not move
 *
 * Owns: the caller, link_close(). Scan-safe: no. Fails: NULL after a message.
 */
struct link *link_open(const struct options *options, struct cycle *cycle,
		       const struct link_store *store);
/** link_begin - starts the thread; the calling thread is the one that scans. Fails: -errno. */
int link_begin(struct link *link);
/** link_serve - does what desks have ordered. Between scans. Scan-safe: yes. */
void link_serve(struct link *link);
/** link_show - copies what desks watch after a scan at @now_ns. Scan-safe: yes. */
void link_show(struct link *link, int64_t now_ns);
/** link_note - records what happens. @now_ns: of NOTE_SCAN. Scan-safe: yes. */
void link_note(struct link *link, enum link_note note, int64_t now_ns);
/** link_doze, link_wake - around each sleep of the scan thread: only then it can be woken for
 * an order. link_doze() of a small board listens itself, until shortly before @until_ns; it
 * returns whether something came, and then there is no time to sleep. Scan-safe: yes. */
bool link_doze(struct link *link, int64_t until_ns);
void link_wake(struct link *link);
/** link_trial_over - the trial of a program has ended: it stays, or the one before runs again
 * (@back). Scan-safe: yes, a system call. */
void link_trial_over(struct link *link, bool back);
/** link_close - ends all sessions and the thread, removes the socket. The cycle's store is
 * the one to be closed then. */
void link_close(struct link *link);
/** link_free - also frees the program that runs, if a download brought it. */
void link_free(struct link *link);
#endif
