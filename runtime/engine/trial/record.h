/* SPDX-License-Identifier: MIT
 *
 * record - records every scan of a twin, so that it can be shown again.
 *
 * A twin is a function of its start and its acts (trial/twin.h). So a record holds its
 * state at intervals, and every act; scans between are computed again. The number of
 * kept scans depends on memory only; the oldest are dropped first. Two threads that
 * record and replay need a lock: record_act(), record_scan() and replay_jump(),
 * replay_next(), replay_seek() of the same record exclude each other.
 */
#ifndef TRIAL_RECORD_H
#define TRIAL_RECORD_H

#include "engine/trial/twin.h"

struct record;

/** record_new - of a twin in its present state, which is the first recorded scan
 * @scans: least number to keep @bytes: most memory, unless there are many acts
 *
 * Owns: the caller, record_free(). Scan-safe: no. Fails: NULL: no memory. */
struct record *record_new(const struct twin *twin, uint64_t scans, size_t bytes);
void record_free(struct record *record);

/** record_act - records that @act was done to @twin and succeeded. Scan-safe: no. Fails:
 * false: no memory; the record begins anew with the present state. */
bool record_act(struct record *record, const struct twin *twin, const struct act *act);
/** record_scan - @twin has run one scan. As record_act. */
bool record_scan(struct record *record, const struct twin *twin);

/* The range of recorded scans. */
uint64_t record_first(const struct record *record);
uint64_t record_last(const struct record *record);
/** record_bytes - memory in use. */
size_t record_bytes(const struct record *record);

/* A view of a record. */
struct replay {
	struct twin twin;         /* the state right after a scan; its programs are those of
				   * the record */
	uint64_t serial;        /* record of that state; 0: none yet */
};
/** replay_init - Owns: replay_free().   Scan-safe: no.   Fails: false: no memory. */
bool replay_init(struct replay *replay, const struct record *record);
void replay_free(struct replay *replay);
/**
 * replay_seek - sets @replay->twin to the state right after scan @scan
 *
 * Starts from its present scan if that is nearer than a frame. Scan-safe: no.
 * Fails: false: @scan is not in the record.
 */
bool replay_seek(struct replay *replay, const struct record *record, uint64_t scan);
/** replay_jump - goes to the nearest frame at or before @scan; replay_next() goes on
 * from there in small steps. As replay_seek. */
bool replay_jump(struct replay *replay, const struct record *record, uint64_t scan);
/** replay_next - one scan on. Fails: false: that was the last. */
bool replay_next(struct replay *replay, const struct record *record);

/** record_each_act - the acts since scan @from, oldest first, each with the number of
 * the scan before it. Scan-safe: no. */
void record_each_act(const struct record *record, uint64_t from,
		     void (*take)(void *context, uint64_t after,
				  const struct act *act), void *context);
#endif
