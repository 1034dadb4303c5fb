/* SPDX-License-Identifier: MIT
 *
 * channels - the part that runs in each scan. It waits for nobody and asks the kernel for nothing but to wake
 * a thread.
 */
#define _GNU_SOURCE /* nanosleep in a handler */
#include "hal/channel_cell.h"
#include "hal/sysfs.h"

#include <errno.h>
#include <math.h>
#include <time.h>
#include <unistd.h>

/* ---- inputs ---- */

void cell_put(struct cell *cell, uint64_t value, bool good, int64_t now_ns)
{
	if (good) {
		atomic_store_explicit(&cell->read, value, memory_order_relaxed);
		atomic_store_explicit(&cell->read_ns, now_ns, memory_order_relaxed);
		atomic_store_explicit(&cell->failures, 0, memory_order_relaxed);
		atomic_fetch_add_explicit(&cell->goods, 1, memory_order_release);
	} else if (atomic_load_explicit(&cell->failures, memory_order_relaxed) < HAL_FAILURES) {
		atomic_fetch_add_explicit(&cell->failures, 1, memory_order_release);
	}
	atomic_fetch_add_explicit(&cell->tries, 1, memory_order_release);
}

/* A low-pass of first order; after a gap it begins anew. */
static double filtered(struct cell *cell, double raw, int64_t now_ns)
{
	const double step = (double)(now_ns - cell->smooth_ns);

	if (!cell->channel.filter_ns || !cell->is_smooth)
		cell->smooth = raw;
	else if (step > 0)
		cell->smooth += (raw - cell->smooth) * step / (step + (double)cell->channel.filter_ns);
	cell->is_smooth = true;
	cell->smooth_ns = now_ns;
	return cell->smooth;
}

/* Between both thresholds a bit stays. */
static bool switched(struct cell *cell, double raw)
{
	if (raw >= cell->channel.on_at)
		cell->bit = true;
	else if (raw < cell->channel.off_below)
		cell->bit = false;
	return cell->bit;
}

/* False: it is outside of its limits. */
static bool take_value(struct cell *cell, int64_t now_ns)
{
	const struct io_channel *channel = &cell->channel;
	const uint64_t bits = atomic_load_explicit(&cell->read, memory_order_relaxed);
	const union iec_value typed = { .i = (int64_t)bits };
	union iec_value value;
	double raw = double_of(bits);

	if (!cell->driver) {
		if (channel->raw == channel->type && !cell->point.active_low && !channel->scaled && !channel->filter_ns &&
		    !channel->limited && !channel->switches) {
			cell->value = typed; /* all 64 bits of it */
			return true;
		}
		raw = channel_number(channel->raw, typed);
	}
	if (!channel_value(channel, raw, &value))
		return false;
	raw = filtered(cell, raw, now_ns);
	channel_value(channel, raw, &value);
	if (channel->switches)
		value.i = switched(cell, raw);
	if (cell->point.active_low && channel->type == IEC_BOOL)
		value.i = !value.i;
	cell->value = value;
	return true;
}

/* Of sim: without a value of its own it leaves the one in the image. This and quality are always good. */
static bool is_always_good(const struct cell *cell)
{
	return cell->point.driver == DRIVER_sim || cell->point.driver == DRIVER_quality;
}

/* An input that a block asks for has no age. It is good until an answer is not. */
static enum hal_quality asked_quality(uint32_t failures)
{
	return failures ? QUALITY_FAULT : QUALITY_GOOD;
}

static enum hal_quality read_cell(struct cell *cell, int64_t now_ns)
{
	const uint32_t goods = atomic_load_explicit(&cell->goods, memory_order_acquire);
	const uint32_t failures = atomic_load_explicit(&cell->failures, memory_order_acquire);
	const int64_t age_ns = now_ns - atomic_load_explicit(&cell->read_ns, memory_order_relaxed);
	enum hal_quality quality = is_always_good(cell) ? QUALITY_GOOD :
		cell->channel.ask ? asked_quality(failures) : failures >= HAL_FAILURES ? QUALITY_FAULT :
		!goods || age_ns > cell->channel.stale_ns ? QUALITY_STALE : QUALITY_GOOD;

	if (quality == QUALITY_GOOD && goods && !take_value(cell, now_ns))
		quality = QUALITY_FAULT;
	if (quality == QUALITY_GOOD)
		return quality;
	cell->is_smooth = false;
	if (cell->channel.substituted)
		cell->value = cell->channel.substitute;
	return quality;
}

static void store_value(const struct cell *cell, struct image *image)
{
	const struct iec_addr addr = cell->point.addr;
	uint8_t *byte = image_area(image, addr.area) + addr.byte;
	const uint8_t mask = (uint8_t)(1u << addr.bit);

	if (addr.bits != 1)
		iec_store(byte, cell->channel.type, cell->value);
	else if (cell->value.i)
		*byte |= mask;
	else
		*byte &= (uint8_t)~mask;
}

static enum hal_quality quality_of_output(const struct cell *cell)
{
	const uint32_t failures = atomic_load_explicit(&cell->failures, memory_order_acquire);

	if (is_always_good(cell))
		return QUALITY_GOOD;
	if (cell->channel.ask)
		return asked_quality(failures);
	if (failures >= HAL_FAILURES)
		return QUALITY_FAULT;
	return failures || !atomic_load_explicit(&cell->goods, memory_order_acquire) ?
		QUALITY_STALE : QUALITY_GOOD;
}

/* Whether a force holds one of @bits bits from @addr on. */
static bool is_held(const struct image *image, struct iec_addr addr, uint32_t bits)
{
	const uint32_t first = 8 * areas_byte(&image->program->areas, addr) + (addr.bits == 1 ? addr.bit : 0);

	for (int i = 0; i < image->force_count; i++) {
		uint32_t from, count;

		if (image_bits(image->program, image->force[i].at, &from, &count) && from < first + bits &&
		    first < from + count)
			return true;
	}
	return false;
}

/* As the program has it: the value that a person holds does not depend on the device. */
static enum hal_quality seen_quality(const struct cell *cell, const struct image *image)
{
	if (is_held(image, cell->point.addr, cell->point.addr.bits))
		return QUALITY_FORCED;
	return (enum hal_quality)atomic_load_explicit(&cell->quality, memory_order_relaxed);
}

/* When all others are known. Whoever asks for a bit wants to know whether to trust the value: that of a person, yes. */
static void tell_quality(const struct channels *channels, struct cell *cell, struct image *image)
{
	const bool held = is_held(image, cell->channel.of, cell->channel.of_bits);
	int worst = QUALITY_GOOD;
	bool bad;

	for (int i = 0; i < cell->of_count; i++) {
		const struct cell *of = &channels->cell[cell->of[i]];
		const int quality = atomic_load_explicit(&of->quality, memory_order_relaxed);

		if (quality > worst && !(held && is_held(image, of->point.addr, of->point.addr.bits)))
			worst = quality;
	}
	bad = worst != QUALITY_GOOD;
	if (!bad && held)
		worst = QUALITY_FORCED;
	cell->value.i = cell->channel.type == IEC_BOOL ? !bad : worst;
	if (iec_type_row(cell->channel.type)->class & CLASS_REAL)
		cell->value.r = worst;
	store_value(cell, image);
}

void channels_read(struct channels *channels, struct image *image, int64_t now_ns)
{
	enum hal_quality worst = QUALITY_GOOD;

	for (int i = 0; channels && i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];
		enum hal_quality quality = cell->point.output ? quality_of_output(cell) :
								read_cell(cell, now_ns);

		if (!cell->point.output && (!is_always_good(cell) || cell->goods))
			store_value(cell, image);
		channels->changes += (int)quality != atomic_load_explicit(&cell->quality, memory_order_relaxed);
		atomic_store_explicit(&cell->quality, (int)quality, memory_order_relaxed);
		if (quality > worst)
			worst = quality;
	}
	for (int i = 0; channels && i < channels->count; i++)
		if (channels->cell[i].point.driver == DRIVER_quality)
			tell_quality(channels, &channels->cell[i], image);
	if (channels)
		atomic_store_explicit(&channels->worst, (int)worst, memory_order_relaxed);
}

/* ---- outputs ---- */

static union iec_value load_value(const struct cell *cell, struct image *image)
{
	const struct iec_addr addr = cell->point.addr;
	const uint8_t *byte = image_area(image, addr.area) + addr.byte;

	if (addr.bits != 1)
		return iec_load(byte, cell->channel.type);
	return (union iec_value){ .i = !!(*byte >> addr.bit & 1) != cell->point.active_low };
}

static void ask(const struct channels *channels, struct cell *cell)
{
	atomic_fetch_add_explicit(&cell->asks, 1, memory_order_release);
	channels_wake(channels, cell);
}

/* Of a gateway with the same type on both sides `wanted` has all bits; else a double. */
static uint64_t wanted_bits(const struct cell *cell, union iec_value value)
{
	const struct io_channel *channel = &cell->channel;

	if (cell->driver)
		return bits_of(channel_raw(channel, value));
	return (uint64_t)channel_wanted(channel, value).i;
}

void channels_write(struct channels *channels, struct image *image, int64_t now_ns)
{
	for (int i = 0; channels && i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];
		uint64_t bits;

		if (!cell->point.output || channels->held)
			continue;
		bits = wanted_bits(cell, load_value(cell, image));
		if (!cell->is_asked || bits != atomic_load_explicit(&cell->wanted, memory_order_relaxed)) {
			atomic_store_explicit(&cell->wanted, bits, memory_order_relaxed);
			atomic_fetch_add_explicit(&cell->serial, 1, memory_order_release);
		} else if (now_ns - cell->asked_ns < cell->channel.refresh_ns) {
			continue;
		}
		cell->is_asked = true;
		cell->asked_ns = now_ns;
		ask(channels, cell);
	}
}

void channels_trace(struct channels *channels, struct image *image, channels_told *told, void *context)
{
	for (int i = 0; told && channels && i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];
		const int quality = seen_quality(cell, image);
		const bool safe = cell->point.output && channels->held && !cell->point.hold;
		const union iec_value value = safe ? cell->channel.safe : load_value(cell, image);

		if (cell->point.driver == DRIVER_quality ||
		    (cell->is_told && quality == cell->told_quality &&
		     (!cell->point.output || memcmp(&value, &cell->told, sizeof(value)) == 0)))
			continue;
		cell->is_told = true;
		cell->told_quality = quality;
		cell->told = value;
		told(context, &cell->point, cell->channel.type, value, (enum hal_quality)quality);
	}
}

double cell_output(const struct channels *channels, const struct cell *cell)
{
	const bool safe = atomic_load_explicit(&channels->held, memory_order_acquire) ||
			  atomic_load_explicit(&cell->leaves, memory_order_acquire) ||
			  !atomic_load_explicit(&cell->serial, memory_order_acquire);

	if (safe && (!cell->point.hold || !atomic_load_explicit(&cell->serial, memory_order_acquire)))
		return cell->safe;
	return double_of(atomic_load_explicit(&cell->wanted, memory_order_relaxed));
}

int64_t cell_number(const struct device *device, double raw)
{
	const double exact = raw / device->scale - device->offset;
	const double most = (double)device->most, least = device->negative ? -most : 0;

	if (exact >= most)
		return device->most;
	return exact > least ? (int64_t)channel_round(exact) : (int64_t)least;
}

/* A converter's highest step is one below its reference: what lies at the reference gets that step. */
int cell_write(const struct cell *cell, int64_t number)
{
	const int file = atomic_load_explicit(&cell->file, memory_order_acquire);
	char text[24];

	for (int i = 0; i < 2; i++) {
		const size_t len = sysfs_print(number - i, text);

		if (pwrite(file, text, len, 0) == (ssize_t)len)
			return 0;
		if (errno != EINVAL || number <= 0)
			break;
	}
	return errno ? -errno : -EIO;
}

/* How long a thread has been in a write; 0: in none. */
static int64_t writes_since(const struct cell *cell)
{
	const int64_t since_ns = atomic_load_explicit(&cell->writing_ns, memory_order_acquire);
	struct timespec now;

	if (!since_ns)
		return 0;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return now.tv_sec * INT64_C(1000000000) + now.tv_nsec - since_ns + 1;
}

/* Writes here and now, because a thread may never run again. A thread that is in the middle of a write may end
 * it behind ours: then once more. One that has hung for 50 ms would only make us hang, too. */
void cell_write_safe(struct cell *cell)
{
	const struct timespec nap = { 0, 100000 };

	for (int i = 0; i < 10; i++) {
		const int64_t since_ns = writes_since(cell);

		if (since_ns > 50000000)
			return;
		cell_write(cell, cell->safe_number);
		if (!since_ns)
			return;
		nanosleep(&nap, NULL);
	}
}

void channels_safe_files(const struct channels *channels, bool fresh,
			 bool (*visit)(void *context, const char *path, int64_t number), void *context)
{
	for (int i = 0; channels && i < channels->count; i++) {
		const struct cell *cell = &channels->cell[i];

		if (cell->driver && cell->point.output && !cell->point.hold && !(fresh && cell->twin) &&
		    !visit(context, cell->device.path, cell->safe_number))
			return;
	}
}

void channels_safe(struct channels *channels)
{
	const int error = errno;

	if (!channels)
		return;
	atomic_store_explicit(&channels->held, 1, memory_order_seq_cst);
	for (int i = 0; i < channels->count; i++) {
		struct cell *cell = &channels->cell[i];

		if (!cell->point.output || cell->point.hold)
			continue;
		if (cell->driver && cell->file >= 0)
			cell_write_safe(cell);
		if (cell->serial)
			atomic_fetch_add_explicit(&cell->serial, 1, memory_order_release);
		ask(channels, cell);
	}
	errno = error;
}

/* What the program wants is a change again. */
void channels_release(struct channels *channels)
{
	if (!channels || !channels->held)
		return;
	atomic_store_explicit(&channels->held, 0, memory_order_release);
	for (int i = 0; i < channels->count; i++)
		channels->cell[i].is_asked = false;
}

/* ---- quality ---- */

enum hal_quality channels_quality(const struct channels *channels)
{
	if (!channels)
		return QUALITY_GOOD;
	return (enum hal_quality)atomic_load_explicit(&channels->worst, memory_order_relaxed);
}

static struct cell *cell_of(const struct channels *channels, int point)
{
	if (!channels || point < 0 || point >= channels->points || channels->of_point[point] < 0)
		return NULL;
	return &channels->cell[channels->of_point[point]];
}

void channels_tell_lines(struct channels *channels, enum hal_quality worst)
{
	if (channels)
		atomic_store_explicit(&channels->lines, (int)worst, memory_order_relaxed);
}

enum hal_quality channels_lines(const struct channels *channels)
{
	return (enum hal_quality)atomic_load_explicit(&channels->lines, memory_order_relaxed);
}

enum hal_quality channels_point(const struct channels *channels, int point)
{
	const struct cell *cell = cell_of(channels, point);

	return !cell ? QUALITY_GOOD :
		(enum hal_quality)atomic_load_explicit(&cell->quality, memory_order_relaxed);
}

uint64_t channels_changes(const struct channels *channels)
{
	return channels ? channels->changes : 0;
}

struct channels_count channels_tally(const struct channels *channels)
{
	struct channels_count count = { 0, 0, 0 };

	for (int i = 0; channels && i < channels->count; i++) {
		const int quality = atomic_load_explicit(&channels->cell[i].quality, memory_order_relaxed);

		count.good += quality == QUALITY_GOOD;
		count.stale += quality == QUALITY_STALE;
		count.fault += quality == QUALITY_FAULT;
	}
	return count;
}

/* ---- gateways ---- */

void channels_put(struct channels *channels, int point, union iec_value value, bool good,
		  int64_t now_ns)
{
	struct cell *cell = cell_of(channels, point);

	if (cell && !cell->driver)
		cell_put(cell, (uint64_t)value.i, good, now_ns);
}

union iec_value channels_get(const struct channels *channels, int point, uint32_t *serial)
{
	const struct cell *cell = cell_of(channels, point);
	union iec_value value = { .i = 0 };

	*serial = 0;
	if (!cell || cell->driver || !cell->point.output)
		return value;
	*serial = atomic_load_explicit(&cell->serial, memory_order_acquire);
	if (atomic_load_explicit(&channels->held, memory_order_acquire) && !cell->point.hold)
		value.i = (int64_t)wanted_bits(cell, cell->channel.safe);
	else
		value.i = (int64_t)atomic_load_explicit(&cell->wanted, memory_order_relaxed);
	return value;
}

void channels_alone(struct channels *channels, enum driver_id of)
{
	for (int i = 0; channels && i < channels->count; i++)
		if (channels->cell[i].point.driver == of)
			atomic_store_explicit(&channels->cell[i].goods, 0, memory_order_release);
}

/* ---- another map ---- */

static void go_on(struct cell *to, const struct cell *from)
{
	to->value = from->value;
	to->smooth = from->smooth;
	to->smooth_ns = from->smooth_ns;
	to->is_smooth = from->is_smooth;
	to->bit = from->bit;
	to->asked_ns = from->asked_ns;
	to->is_asked = from->is_asked;
	if (!to->driver || to->point.output) {
		to->read = from->read;
		to->read_ns = from->read_ns;
		to->failures = from->failures;
		to->goods = from->goods;
	}
	to->wanted = from->wanted;
	to->serial = from->serial;
	if (from->written != from->asks)
		to->asks++;
}

void channels_exchange(struct channels *now, struct channels *next)
{
	const int held = now ? now->held : next ? next->held : 0;

	if (now)
		now->active = false;
	for (int i = 0; now && i < now->count; i++) {
		struct cell *cell = &now->cell[i];

		if (cell->twin) {
			go_on(cell->twin, cell);
			channels_wake(next, cell->twin);
			continue;
		}
		cell->leaves = true;
		ask(now, cell);
	}
	for (int i = 0; next && i < next->count; i++) {
		if (next->cell[i].leaves)
			next->cell[i].is_asked = false; /* it has its safe value */
		next->cell[i].leaves = false;
	}
	if (next) {
		next->held = held;
		next->active = true;
	}
}
