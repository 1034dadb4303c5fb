/* SPDX-License-Identifier: MIT
 *
 * diff_match - longest common subsequence by E. W. Myers' greedy method ("An O(ND)
 * difference algorithm and its variations", 1986), with a limit on its work.
 *
 * It compares numbers; equal numbers stand for equal rungs or lines.
 */
#include "engine/compare/diff_match.h"

#include <string.h>

struct search {
	struct arena *arena;
	const uint32_t *a, *b;
	int a_count, b_count;
	int *reach;      /* by diagonal: how far in a; [-limit-1 … limit+1]   */
	int **trace;     /* reach after 0, 1, 2 … changes; middle: [changes] */
};

static bool came_down(const int *reach, int diagonal, int changes)
{
	return diagonal == -changes ||
	       (diagonal != changes &&
		reach[diagonal - 1] < reach[diagonal + 1]);
}

static int slide(const struct search *search, int x, int y)
{
	while (x < search->a_count && y < search->b_count &&
	       search->a[x] == search->b[y])
		x++, y++;
	return x;
}

/* One more change; true when both ends are reached. */
static bool advance(const struct search *search, int changes)
{
	int *reach = search->reach;

	for (int k = -changes; k <= changes; k += 2) {
		int x = came_down(reach, k, changes) ? reach[k + 1] :
						       reach[k - 1] + 1;
		reach[k] = slide(search, x, x - k);
		if (k == search->a_count - search->b_count &&
		    reach[k] >= search->a_count)
			return true;
	}
	return false;
}

static bool remember(const struct search *search, int changes)
{
	size_t size = (size_t)(2 * changes + 1) * sizeof(int);
	int *copy = arena_alloc(search->arena, size);

	if (!copy)
		return false;
	memcpy(copy, search->reach - changes, size);
	search->trace[changes] = copy;
	return true;
}

static void walk_back(const struct search *search, int changes, int *match)
{
	int x = search->a_count, y = search->b_count;

	for (; changes > 0; changes--) {
		const int *reach = search->trace[changes - 1] + changes - 1;
		int k = x - y;
		int from = came_down(reach, k, changes) ? k + 1 : k - 1;

		while (x > reach[from] && y > reach[from] - from)
			match[--x] = --y;
		x = reach[from];
		y = x - from;
	}
	while (x > 0 && y > 0)
		match[--x] = --y;
}

static bool search_middle(struct search *search, int *match)
{
	int most = search->a_count + search->b_count;
	int limit = most < DIFF_LIMIT ? most : DIFF_LIMIT;
	int *reach = arena_alloc(search->arena,
				 (size_t)(2 * limit + 3) * sizeof(int));

	search->trace = arena_alloc(search->arena,
				    (size_t)(limit + 1) * sizeof(int *));
	if (!reach || !search->trace)
		return false;
	search->reach = reach + limit + 1;
	for (int changes = 0; changes <= limit; changes++) {
		if (advance(search, changes)) {
			walk_back(search, changes, match);
			return true;
		}
		if (!remember(search, changes))
			return false;
	}
	for (int i = 0; i < search->a_count && i < search->b_count; i++)
		if (search->a[i] == search->b[i])
			match[i] = i;
	return true;
}

bool diff_match(struct arena *arena, const uint32_t *a, int a_count,
		const uint32_t *b, int b_count, int *match)
{
	int head = 0, tail = 0;

	for (int i = 0; i < a_count; i++)
		match[i] = -1;
	for (; head < a_count && head < b_count && a[head] == b[head]; head++)
		match[head] = head;
	for (; tail < a_count - head && tail < b_count - head &&
	       a[a_count - 1 - tail] == b[b_count - 1 - tail]; tail++)
		match[a_count - 1 - tail] = b_count - 1 - tail;

	struct search search = { arena, a + head, b + head,
				 a_count - head - tail, b_count - head - tail,
				 NULL, NULL };
	if (search.a_count == 0 || search.b_count == 0)
		return true;
	if (!search_middle(&search, match + head))
		return false;
	for (int i = head; i < a_count - tail; i++)
		if (match[i] >= 0)
			match[i] += head;
	return true;
}
