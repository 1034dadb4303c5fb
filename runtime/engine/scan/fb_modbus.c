/* SPDX-License-Identifier: MIT
 *
 * fb_modbus - MB_READ and MB_WRITE.
 *
 * A request is a number. Its answer has the lower half of that number above and a status below. The blocks
 * know no bus: runtime/ladderd/asks.h carries both.
 */
#include "engine/scan/fb.h"

enum { NO_ANSWER = 256 };

/* What both have, so that one function does the work. */
struct request {
	uint8_t *busy, *done, *error;
	uint16_t *status;
	uint32_t *asked;
	int64_t *start;
	uint32_t answer;
	int64_t timeout;
};

static void end(const struct request *request, uint16_t status)
{
	*request->busy = 0;
	*request->status = status;
	*request->done = status == 0;
	*request->error = status != 0;
}

static void step(const struct request *request, bool now, bool rises, int64_t now_ns)
{
	const bool late = request->timeout > 0 && fb_since(now_ns, *request->start) >= (uint64_t)request->timeout;

	if (*request->busy && request->answer >> 16 == (*request->asked & 0xffff))
		end(request, request->answer & 0xffff);
	else if (*request->busy && late)
		end(request, NO_ANSWER);
	else if (!now)
		*request->done = *request->error = 0;
	if (!rises || *request->busy)
		return;
	/* An answer of 0 is none. */
	*request->asked += (*request->asked & 0xffff) == 0xffff ? 2 : 1;
	*request->busy = 1;
	*request->done = *request->error = 0;
	*request->status = 0;
	*request->start = now_ns;
}

#define STEP(fb) do { \
	const bool rises = fb_rises((fb)->REQ, &(fb)->seen); \
	const struct request request = { \
		&(fb)->BUSY, &(fb)->DONE, &(fb)->ERROR, &(fb)->STATUS, &(fb)->asked, &(fb)->start, \
		(fb)->answer, (fb)->TIMEOUT, \
	}; \
\
	step(&request, (fb)->REQ != 0, rises, now_ns); \
} while (0)

void fb_MB_READ_step(struct fb_MB_READ *fb, int64_t now_ns)
{
	STEP(fb);
}

void fb_MB_WRITE_step(struct fb_MB_WRITE *fb, int64_t now_ns)
{
	STEP(fb);
}
