/* SPDX-License-Identifier: MIT
 *
 * field - the values of points between the threads of the buses and the one that talks to ladderd.
 *
 * Each point has one place. A newer value replaces the one before, so nobody writes an old one. It knows
 * no bus and no link.
 */
#ifndef MODBUS_FIELD_H
#define MODBUS_FIELD_H

#include "engine/base/iec.h"

#include <pthread.h>

struct field_place {
	union iec_value input; /* read from the wire; of an output: written     */
	bool good;
	bool fresh;            /* not yet taken                                */
	union iec_value output; /* to be written                               */
	uint32_t serial;       /* of `output`; 0: no value yet                 */
};

struct field {
	pthread_mutex_t lock;
	struct field_place *place; /* one for each point of the map           */
	int count;
	int *fresh;            /* places with a fresh input, in order of arrival */
	int fresh_count;
	int wake_fd;           /* readable when there is a fresh input          */
};

/** field_open - places for @count points. Owns: field_close(). Fails: false: no memory. */
bool field_open(struct field *field, int count);
void field_close(struct field *field);
/** field_put - an input was read, or an output written; field->lock is held. field_wake() once after some of them. */
void field_put(struct field *field, int point, union iec_value value, bool good);
void field_wake(struct field *field);
struct field_fresh {
	int point;
	union iec_value value;
	bool good;
};
/** field_take - copies all fresh inputs to @out, which has room for all points, and forgets that they were
 * fresh. Returns how many. */
int field_take(struct field *field, struct field_fresh *out);
/** field_output - a new value for an output; then wake the thread that writes it. */
void field_output(struct field *field, int point, union iec_value value);
#endif
