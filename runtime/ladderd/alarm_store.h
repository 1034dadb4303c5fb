/* SPDX-License-Identifier: MIT
 *
 * alarm_store - the list of alarms in a file: each row has two places that are written in turn.
 *
 * Used by the link thread only. A row that changes is written at once, further changes at most every
 * ALARM_STORE_NS: an alarm that chatters does not wear out a card. What a disk does not take is
 * written again after the same time.
 */
#ifndef LADDERD_ALARM_STORE_H
#define LADDERD_ALARM_STORE_H

#include "online/alarms.h"

#define ALARM_STORE_NS INT64_C(10000000000)
#define ALARM_PIECE    32u     /* records that are read at once                */

struct alarm_store {
	const char *folder;            /* of the file `alarms`; NULL: none     */
	int fd;                        /* -1: no file                          */
	int error;                     /* an errno: why alarms are not stored now; 0: they are */
	bool unread;                   /* the file could not be opened yet     */
	int64_t written_ns;
	uint32_t version[ALARM_ROWS];
	uint8_t bytes[ALARM_PIECE * ALARM_BYTES]; /* of the rows that are read, or of the one that is written */
};

/** alarm_store_open - loads the rows of the file `alarms` in @folder; NULL: none
 * @now_ns: since 1970; for the alarm that tells of damaged rows
 *
 * @folder must live as long. Owns: the caller, alarm_store_close(). A file that cannot be used is
 * told, and opened later. */
void alarm_store_open(struct alarm_store *store, const char *folder, struct alarm_list *list,
		      int64_t now_ns);
/** alarm_store_write - writes changed rows, if it is time. @now_ns: monotonic. */
void alarm_store_write(struct alarm_store *store, struct alarm_list *list, int64_t now_ns);
/** alarm_store_close - writes all that has changed. */
void alarm_store_close(struct alarm_store *store, struct alarm_list *list);
#endif
