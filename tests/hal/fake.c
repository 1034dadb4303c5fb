/* SPDX-License-Identifier: MIT
 *
 * fake - the chips of a test. Like the kernel, they refuse lines that are in use, fail
 * after they were unplugged, and do not know old requests after they were plugged in again.
 */
#include "tests/hal/fake.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

struct fake fake;
void (*fake_at_read)(void);
void (*fake_at_open)(void);
void (*fake_at_write)(void);

void fake_reset(void)
{
	memset(&fake, 0, sizeof(fake));
}

void fake_clear_calls(void)
{
	memset(fake.calls, 0, sizeof(fake.calls));
	fake.call_count = 0;
	fake.reads = fake.writes = fake.takes = fake.releases = 0;
}

/* ladderd lists the chips of its machine in a thread of its own, while scans go on. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

/* Notes a call and counts it. */
static void note(char call, int *count)
{
	pthread_mutex_lock(&lock);
	if (fake.call_count < sizeof(fake.calls) - 1)
		fake.calls[fake.call_count++] = call;
	++*count;
	pthread_mutex_unlock(&lock);
}

void fake_settings(int more)
{
	pthread_mutex_lock(&lock);
	fake.settings += more;
	pthread_mutex_unlock(&lock);
}

struct fake_line fake_line(const struct fake_chip *chip, unsigned int offset)
{
	struct fake_line line;

	pthread_mutex_lock(&lock);
	line = chip->line[offset];
	pthread_mutex_unlock(&lock);
	return line;
}

void fake_unplug(int chip)
{
	fake.chip[chip].present = false;
	fake.chip[chip].generation++;
	for (int i = 0; i < FAKE_LINES; i++) {
		fake.chip[chip].line[i].used = false;
		fake.chip[chip].line[i].owner = NULL;
	}
}

void *fake_new(size_t size)
{
	void *object = aligned_alloc(16, (size + 15) & ~(size_t)15);

	return object ? memset(object, 0, size) : NULL;
}

bool fake_fails(void)
{
	if (fake.good_calls == 0 || --fake.good_calls > 0)
		return false;
	fake.call_failed = true;
	errno = fake.call_error;
	return true;
}

struct fake_chip *fake_open(const char *path)
{
	const char *name = strstr(path, "gpiochip");
	int number = name ? atoi(name + 8) : -1; /* a path of the test */
	struct fake_chip *chip;

	if (fake_at_open)
		fake_at_open();
	if (fake_fails())
		return NULL;
	if (number < 0 || number >= FAKE_CHIPS ||
	    !fake.chip[number].present) {
		errno = ENOENT;
		return NULL;
	}
	chip = &fake.chip[number];
	if (chip->open_error) {
		errno = chip->open_error;
		return NULL;
	}
	note('o', &fake.opens);
	return chip;
}

void fake_close(void)
{
	note('c', &fake.closes);
}

int fake_take(struct fake_request *request, struct fake_chip *chip,
	      const char *owner, const int *values, const char *bias,
	      const char *drive)
{
	note(request->output ? 'O' : 'I', &fake.takes);
	request->chip = chip;
	request->generation = chip->generation;
	if (fake.take_error) {
		errno = fake.take_error;
		return -1;
	}
	if (fake_fails())
		return -1;
	for (size_t i = 0; i < request->count; i++) {
		if (request->offset[i] >= chip->lines ||
		    fake_line(chip, request->offset[i]).used) {
			errno = EBUSY;
			return -1;
		}
	}
	pthread_mutex_lock(&lock);
	for (size_t i = 0; i < request->count; i++) {
		struct fake_line *line = &chip->line[request->offset[i]];

		line->used = true;
		line->owner = owner;
		line->output = request->output;
		line->bias = bias[i];
		line->drive = drive[i];
		if (request->output)
			line->level = values[i];
	}
	pthread_mutex_unlock(&lock);
	return 0;
}

void fake_release(struct fake_request *request)
{
	note('x', &fake.releases);
	if (request->generation != request->chip->generation)
		return;
	pthread_mutex_lock(&lock);
	for (size_t i = 0; i < request->count; i++) {
		request->chip->line[request->offset[i]].used = false;
		request->chip->line[request->offset[i]].owner = NULL;
	}
	pthread_mutex_unlock(&lock);
}

static int answer(const struct fake_request *request, int error)
{
	if (fake_fails())
		return -1;
	if (request->generation != request->chip->generation)
		error = ENODEV;
	errno = error;
	return error ? -1 : 0;
}

int fake_read(const struct fake_request *request, int *values)
{
	note('r', &fake.reads);
	if (fake_at_read)
		fake_at_read();
	if (answer(request, fake.read_error))
		return -1;
	for (size_t i = 0; i < request->count; i++)
		values[i] = request->chip->line[request->offset[i]].level;
	return 0;
}

int fake_write(const struct fake_request *request, const int *values)
{
	note('w', &fake.writes);
	if (fake_at_write)
		fake_at_write();
	if (answer(request, fake.write_error))
		return -1;
	pthread_mutex_lock(&lock);
	for (size_t i = 0; i < request->count; i++)
		request->chip->line[request->offset[i]].level = values[i];
	pthread_mutex_unlock(&lock);
	return 0;
}
