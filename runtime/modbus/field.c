/* SPDX-License-Identifier: MIT
 *
 * field - the places of values, below one lock that is held for copies only.
 */
#include "modbus/field.h"

#include <stdlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

bool field_open(struct field *field, int count)
{
	const size_t most = count ? (size_t)count : 1;

	*field = (struct field){ .place = calloc(most, sizeof(*field->place)),
				 .fresh = calloc(most, sizeof(*field->fresh)), .count = count,
				 .wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC) };
	pthread_mutex_init(&field->lock, NULL);
	if (field->place && field->fresh && field->wake_fd >= 0)
		return true;
	field_close(field);
	return false;
}

void field_close(struct field *field)
{
	free(field->place);
	free(field->fresh);
	if (field->wake_fd >= 0)
		close(field->wake_fd);
	pthread_mutex_destroy(&field->lock);
	field->place = NULL;
	field->fresh = NULL;
	field->wake_fd = -1;
}

void field_put(struct field *field, int point, union iec_value value, bool good)
{
	struct field_place *place = &field->place[point];

	place->input = value;
	place->good = good;
	if (!place->fresh)
		field->fresh[field->fresh_count++] = point;
	place->fresh = true;
}

void field_wake(struct field *field)
{
	const uint64_t one = 1;

	/* A counter that is full wakes, too. */
	if (write(field->wake_fd, &one, sizeof(one)) < 0)
		return;
}

int field_take(struct field *field, struct field_fresh *out)
{
	uint64_t many;
	int count;

	if (read(field->wake_fd, &many, sizeof(many)) < 0)
		return 0;
	pthread_mutex_lock(&field->lock);
	count = field->fresh_count;
	for (int i = 0; i < count; i++) {
		struct field_place *place = &field->place[field->fresh[i]];

		place->fresh = false;
		out[i] = (struct field_fresh){ field->fresh[i], place->input, place->good };
	}
	field->fresh_count = 0;
	pthread_mutex_unlock(&field->lock);
	return count;
}

void field_output(struct field *field, int point, union iec_value value)
{
	pthread_mutex_lock(&field->lock);
	field->place[point].output = value;
	if (++field->place[point].serial == 0)
		field->place[point].serial = 1;
	pthread_mutex_unlock(&field->lock);
}
