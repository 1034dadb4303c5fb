/* SPDX-License-Identifier: MIT
 *
 * journal - the log of a board: a ring of records in one file, and the same ring in memory.
 *
 * A record is in the file when journal_add() returns, so it survives the end of ladderd; it is
 * on the disk within a second. What a disk does not take is written again each second. Without
 * a file the log lasts as long as ladderd. Used by the link thread only.
 */
#ifndef LADDERD_JOURNAL_H
#define LADDERD_JOURNAL_H

#include "online/event.h"

struct journal;

/** journal_open - @folder: of the file `events`; NULL: none. Owns: the caller,
 * journal_close(). Fails: NULL: no memory; a file that cannot be used is reported. */
struct journal *journal_open(const char *folder);
void journal_close(struct journal *journal);
/** journal_add - numbers and stores an event; its texts are cut. */
void journal_add(struct journal *journal, enum event_id id, uint8_t role, const char *user,
		 const char *one, const char *two);
/** journal_next - the first event from number @seq on. Fails: false: there is none yet. */
bool journal_next(const struct journal *journal, uint32_t seq, struct event *out);
/** journal_sync - puts new records on the disk, at most once a second. */
void journal_sync(struct journal *journal, int64_t now_ns);
/** journal_error - an errno: why events are not stored now; 0: they are, or there is no file. */
int journal_error(const struct journal *journal);
#endif
