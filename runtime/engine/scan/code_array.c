/* SPDX-License-Identifier: MIT
 *
 * code_array - verifies arrays: every element is a place of its type.
 *
 * A hostile image must not make loading slow: elements in one run, or in one area, are
 * checked together, however many there are.
 */
#include "engine/scan/verify.h"

#include <string.h>

/* Whether all elements are in one run, each at the same place of its unit. Then a check
 * of the first is enough. */
static bool in_run(const struct verifier *v, uint32_t offset, uint64_t end,
		   uint32_t stride)
{
	const struct code_run *run = code_run_at(v->program, offset);

	return run && stride % code_run_size(run) == 0 &&
	       end <= run->offset + (uint64_t)run->count * code_run_size(run);
}

/* Marks do not give the room of a text; its run does. */
static bool has_room(const struct verifier *v, uint32_t offset, uint32_t room)
{
	const struct code_run *run = code_run_at(v->program, offset);

	return run && run->kind != RUN_INSTANCE && run->word == room;
}

static bool walk(struct verifier *v, uint32_t first, uint32_t count,
		 uint32_t stride, bool write)
{
	bool text = CODE_TYPE(first) == IEC_STRING;
	const struct code_run *run = code_run_at(v->program, CODE_OFFSET(first));

	if (count > LIMIT_ELEMENT_WALK - v->walked || !run)
		return false;
	v->walked += count;
	for (uint32_t i = 0; i < count; i++) {
		uint32_t offset = CODE_OFFSET(first) + i * stride;

		if (!verify_use(v, offset, CODE_TYPE(first), write) ||
		    (text && !has_room(v, offset, run->word)))
			return false;
	}
	return true;
}

/* The same member of all elements is checked again and again, so the result is kept. */
static struct seen *seen_slot(const struct verifier *v, uint32_t first)
{
	return &v->seen[(first * 2654435761u) >> 22 & (VERIFY_SEEN - 1)];
}

static bool was_walked(const struct verifier *v, uint32_t first, uint32_t count,
		       uint32_t stride, bool write)
{
	const struct seen *seen = seen_slot(v, first);

	return seen->first == first && seen->stride == stride &&
	       seen->count >= count && seen->write >= write;
}

bool verify_elements(struct verifier *v, uint32_t first, uint32_t count,
		     uint32_t stride, bool write)
{
	uint32_t offset = CODE_OFFSET(first), type = CODE_TYPE(first);
	uint64_t end;

	/* A store with a stride of 0 is the check of a subrange: only its index matters. */
	if (!count || (!stride && !write) || !verify_use(v, offset, type, write))
		return false;
	end = offset + (uint64_t)(count - 1) * stride +
	      iec_type_row((enum iec_type)type)->size;
	if (end > v->data_size)
		return false;
	if (offset < v->areas)
		return end <= v->areas &&
		       areas_find(&v->program->areas, offset) ==
		       areas_find(&v->program->areas, (uint32_t)end - 1);
	if (in_run(v, offset, end, stride))
		return true;
	if (!v->seen)
		v->seen = arena_alloc(v->scratch, VERIFY_SEEN * sizeof(*v->seen));
	if (!v->seen)
		return false;
	if (was_walked(v, first, count, stride, write))
		return true;
	if (!walk(v, first, count, stride, write))
		return false;
	*seen_slot(v, first) = (struct seen){ first, count, stride, write };
	return true;
}

/* ---- several indices ---- */

bool verify_grid_begin(const struct verifier *v, struct verify_grid *grid, uint32_t base,
		       const uint32_t *dim, uint32_t dims)
{
	memset(grid, 0, sizeof(*grid));
	grid->dim = dim;
	grid->dims = dims;
	grid->offset = base;
	for (; dims > 0; dims--, dim += CODE_DIMENSION)
		if (!dim[2] || !dim[3] ||
		    (uint64_t)(dim[2] - 1) * dim[3] > v->data_size)
			return false;
	return true;
}

bool verify_grid_next(struct verifier *v, struct verify_grid *grid)
{
	for (uint32_t i = grid->dims; i > 0; i--) {
		const uint32_t *dim = grid->dim + (i - 1) * CODE_DIMENSION;
		uint32_t *at = &grid->at[i - 1];

		if (*at + 1 < dim[2]) {
			++*at;
			grid->offset += dim[3];
			grid->failed = ++v->walked > LIMIT_ELEMENT_WALK;
			return !grid->failed;
		}
		grid->offset -= (uint64_t)*at * dim[3];
		*at = 0;
	}
	return false;
}

/* The last index is checked as a whole, for each combination of the others. */
bool verify_elements_of(struct verifier *v, uint32_t first, const uint32_t *dim,
			uint32_t dims, bool write)
{
	const uint32_t *last = dim + (dims - 1) * CODE_DIMENSION;
	struct verify_grid grid;

	if (!verify_grid_begin(v, &grid, CODE_OFFSET(first), dim, dims - 1))
		return false;
	do {
		if (grid.offset >= v->data_size ||
		    !verify_elements(v, CODE_OPERAND(CODE_TYPE(first),
						     (uint32_t)grid.offset),
				     last[2], last[3], write))
			return false;
	} while (verify_grid_next(v, &grid));
	return !grid.failed;
}

bool verify_bits(const struct verifier *v, uint32_t first, uint64_t count,
		 bool write)
{
	const struct areas *areas = &v->program->areas;
	uint64_t last = first + count - 1;
	enum iec_area area = areas_find(areas, first / 8);

	if (!count || area == AREA_NONE || last / 8 >= v->areas ||
	    area != areas_find(areas, (uint32_t)(last / 8)))
		return false;
	return !write || iec_area_row(area)->access == ACCESS_WRITE;
}

/* ---- bounds in names ---- */

/* A number of at most ten digits, perhaps negative; moves *at behind it. */
static bool take_number(const char **at, int64_t *out)
{
	bool negative = **at == '-';
	const char *start = *at + negative;
	const char *end = start;

	for (*out = 0; *end >= '0' && *end <= '9' && end - start < 10; end++)
		*out = *out * 10 + (*end - '0');
	if (negative)
		*out = -*out;
	*at = end;
	return end != start && *out >= INT32_MIN && *out <= INT32_MAX;
}

struct code_bounds code_bounds(const char *name)
{
	struct code_bounds none = { strlen(name), 0, 0 }, out = none;
	const char *at = NULL;
	int64_t low, high;

	for (const char *c = name; *c; c++) /* Line[2].Times[1..5] */
		at = *c == '[' ? c : at;
	if (!at || at == name)
		return none;
	out.head = (size_t)(at - name);
	at++;
	if (!take_number(&at, &low) || at[0] != '.' || at[1] != '.')
		return none;
	at += 2;
	if (!take_number(&at, &high) || strcmp(at, "]") != 0 || high < low ||
	    high - low >= LIMIT_ELEMENTS)
		return none;
	out.low = (int32_t)low;
	out.count = (uint32_t)(high - low + 1);
	return out;
}

/* ---- values one after another ---- */

bool verify_all(const struct verifier *v, uint32_t first, uint32_t n, enum iec_type type,
		bool write)
{
	uint32_t size = iec_type_row(type)->size;

	if (n == 0 || first > v->data_size || n > (v->data_size - first) / size)
		return false;
	for (uint32_t i = 0; i < n; i++)
		if (!verify_use(v, first + i * size, type, write))
			return false;
	return true;
}

bool verify_tick(const struct verifier *v, const uint32_t *at, uint32_t n)
{
	return verify_use(v, at[0], IEC_BOOL, false) &&
	       verify_use(v, at[1], IEC_TIME, true) &&
	       verify_use(v, at[2], IEC_TIME, true) &&
	       verify_all(v, at[3], n, IEC_BOOL, false) &&
	       verify_all(v, at[4], n, IEC_TIME, true);
}
