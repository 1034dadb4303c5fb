/* SPDX-License-Identifier: MIT
 *
 * record - every scan of a twin, to be looked at again.
 *
 * A twin is a function of its start and its acts (trial/twin.h), so a record holds its
 * state now and then and every act between, and runs the scans between again when one is
 * asked for. How many scans it keeps depends on memory alone, not on what they did; the
 * oldest go first. Whoever records and looks in two threads holds a lock: record_act(),
 * record_scan() and replay_jump(), replay_next(), replay_seek() of the same record exclude each other.
 */
#ifndef TRIAL_RECORD_H
#define TRIAL_RECORD_H

#include "engine/trial/twin.h"

struct record;

/** record_new - of a twin as it is; the first scan to be had is its current one
 * @scans: to be kept at least   @bytes: to be used at most, as far as acts are few
 *
 * Owns: the caller, record_free().   Scan-safe: no.   Fails: NULL: no memory. */
struct record *record_new(const struct twin *twin, uint64_t scans, size_t bytes);
void record_free(struct record *record);

/** record_act - @act was done to @twin, and took effect. Scan-safe: no. Fails: false: no
 * memory; the record begins anew with the twin as it is. */
bool record_act(struct record *record, const struct twin *twin, const struct act *act);
/** record_scan - @twin has run one scan. As record_act. */
bool record_scan(struct record *record, const struct twin *twin);

/* Scans that can be had. */
uint64_t record_first(const struct record *record);
uint64_t record_last(const struct record *record);
/** record_bytes - memory that it uses now. */
size_t record_bytes(const struct record *record);

/** record_apart - scans from the last frame to the next, as it is now: how many at most
 * are run again to show one. */
uint64_t record_apart(const struct record *record);

/* Somebody who looks at a record. */
struct replay {
	struct twin twin;         /* as it was right after the scan; its programs are
				   those of the record                        */
	uint64_t serial;        /* of the record that it was of; 0: of none yet */
};
/** replay_init - Owns: replay_free().   Scan-safe: no.   Fails: false: no memory. */
bool replay_init(struct replay *replay, const struct record *record);
void replay_free(struct replay *replay);
/**
 * replay_seek - @replay->twin is as it was right after scan @scan
 *
 * From where it stands, if that is nearer than what the record keeps. Scan-safe: no.
 * Fails: false: the record does not reach there.
 */
bool replay_seek(struct replay *replay, const struct record *record, uint64_t scan);
/** replay_jump - the nearest scan at or before @scan that can be had without running one;
 * replay_next() goes on from there, a little at a time. As replay_seek. */
bool replay_jump(struct replay *replay, const struct record *record, uint64_t scan);
/** replay_next - one scan on. Fails: false: that was the last. */
bool replay_next(struct replay *replay, const struct record *record);

/** record_each_act - the acts since scan @from, oldest first, each with the scan after
 * which it was done.   Scan-safe: no. */
void record_each_act(const struct record *record, uint64_t from,
		     void (*take)(void *context, uint64_t after,
				  const struct act *act), void *context);
#endif
