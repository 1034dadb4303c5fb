/* SPDX-License-Identifier: MIT
 *
 * nameless - requests of one desk, served in the thread that scans.
 */
#include "ladderd/nameless.h"

#include "engine/base/digest.h"
#include "engine/base/file.h"
#include "engine/base/version.h"
#include "engine/scan/place.h"
#include "ladderd/control.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#define KEPT_FOR   1024             /* requests: then the number may have come round */
#define BLOCK_HEAD (WIRE_HEAD + 4u) /* of a frame of `block`: with the offset */

struct asked {
	struct nameless *nameless;
	const struct service_row *row;
	struct frame frame;
	struct wire_writer out;
	const char *detail;            /* of a refusal; parts of a diagnostic  */
	char text[120];                /* … if it is made                      */
};

/* ---- answers ---- */

static void begin_answer(struct asked *asked, uint8_t flags)
{
	asked->out = wire_write(asked->nameless->out, sizeof(asked->nameless->out));
	frame_begin(&asked->out, asked->frame.service, (uint8_t)(WIRE_ANSWER | flags),
		    asked->frame.request);
}

static void refuse(struct asked *asked, enum refusal refusal)
{
	begin_answer(asked, WIRE_REFUSED);
	wire_put_u16(&asked->out, (uint16_t)refusal);
	wire_put_string(&asked->out, asked->detail);
}

static enum refusal answer_scan(struct asked *asked, enum refusal refusal, uint64_t scan)
{
	if (refusal == REFUSAL_NONE) {
		begin_answer(asked, 0);
		wire_put_u64(&asked->out, scan);
	}
	return refusal;
}

/* @what is possible only in another mode. */
static enum refusal not_now(struct asked *asked, const char *what, uint8_t needed)
{
	snprintf(asked->text, sizeof(asked->text), "%s" DIAG_AND "%s" DIAG_AND "%s", what,
		 mode_word(needed),
		 mode_word((uint8_t)asked->nameless->cycle->resource.state));
	asked->detail = asked->text;
	return REFUSAL_NOT_NOW;
}

static enum refusal refuse_role(struct asked *asked, enum role needed)
{
	snprintf(asked->text, sizeof(asked->text), "%s" DIAG_AND "%s" DIAG_AND "%s",
		 asked->row->word, role_word(needed), role_word(asked->nameless->role));
	asked->detail = asked->text;
	return REFUSAL_ROLE;
}

static bool is_expected(const struct asked *asked, const struct expect *expect)
{
	const struct cycle *cycle = asked->nameless->cycle;

	return (expect->mode == EXPECT_ANY || expect->mode == cycle->resource.state) &&
	       memcmp(expect->program, cycle->identity_bytes, 32) == 0;
}

/* ---- variables ---- */

static enum refusal find_place(struct asked *asked, const struct ref *ref, struct location *at)
{
	const struct image *image = &asked->nameless->cycle->resource.image;
	enum iec_addr_result result = ADDR_OK;
	struct iec_addr addr;

	if (ref->kind == REF_PLACE) {
		*at = place_locate(image->program, ref->place);
		snprintf(asked->text, sizeof(asked->text), "place %08x", (unsigned)ref->place);
	} else {
		snprintf(asked->text, sizeof(asked->text), "%.*s",
			 ref->len < 80 ? (int)ref->len : 80, ref->name);
		result = iec_addr_parse(ref->name, ref->len, &addr);
		*at = result == ADDR_OK ? image_locate(image, addr) :
					  (struct location){ .type = IEC_NONE };
	}
	asked->detail = asked->text;
	return result == ADDR_NONE ? REFUSAL_NO_NAMES :
	       at->type == IEC_NONE ? REFUSAL_NO_NAME : REFUSAL_NONE;
}

static enum refusal take_count(struct asked *asked, uint32_t *count)
{
	*count = wire_u16(&asked->frame.body);
	if (asked->frame.body.failed)
		return REFUSAL_BAD_FRAME;
	snprintf(asked->text, sizeof(asked->text), "%u variables; at most %u", (unsigned)*count,
		 NAMELESS_ITEMS);
	asked->detail = asked->text;
	return *count > NAMELESS_ITEMS ? REFUSAL_TOO_MANY : REFUSAL_NONE;
}

/* References; with @values a type and a value behind each. */
static enum refusal take_items(struct asked *asked, bool values, uint32_t *count)
{
	struct nameless *nameless = asked->nameless;
	struct wire_reader *in = &asked->frame.body;
	enum refusal refusal = take_count(asked, count);
	uint32_t texts = 0;

	for (uint32_t i = 0; i < *count && refusal == REFUSAL_NONE; i++) {
		const struct ref ref = wire_ref(in);
		const enum iec_type type = values ? (enum iec_type)wire_u8(in) : IEC_NONE;

		if (type == IEC_STRING && texts == NAMELESS_TEXTS)
			return REFUSAL_TOO_MANY;
		if (values)
			nameless->value[i] = wire_value(in, type, &nameless->text[texts]);
		texts += type == IEC_STRING;
		if (in->failed)
			return REFUSAL_BAD_FRAME;
		refusal = find_place(asked, &ref, &nameless->place[i]);
		if (refusal == REFUSAL_NONE && values && nameless->place[i].type != type)
			refusal = REFUSAL_TYPE;
	}
	if (refusal != REFUSAL_NONE)
		return refusal;
	asked->detail = "";
	return wire_done(in) ? REFUSAL_NONE : REFUSAL_BAD_FRAME;
}

static uint8_t quality(const struct resource *resource, struct location at)
{
	return (image_is_forced(&resource->image, at) ? VALUE_FORCED : 0) |
	       (resource->io_fault ? VALUE_STALE : 0);
}

static enum refusal serve_read(struct asked *asked)
{
	struct nameless *nameless = asked->nameless;
	const struct resource *resource = &nameless->cycle->resource;
	uint32_t count;
	const enum refusal refusal = take_items(asked, false, &count);

	if (refusal != REFUSAL_NONE)
		return refusal;
	begin_answer(asked, 0);
	wire_put_u8(&asked->out, (uint8_t)resource->state);
	wire_put_u64(&asked->out, resource->scans);
	wire_put_i64(&asked->out, resource->vm.now_ns);
	wire_put_u16(&asked->out, (uint16_t)count);
	for (uint32_t i = 0; i < count; i++) {
		const struct location at = nameless->place[i];

		wire_put_u8(&asked->out, quality(resource, at));
		wire_put_u8(&asked->out, (uint8_t)at.type);
		wire_put_value(&asked->out, at.type, image_get(&resource->image, at));
	}
	return REFUSAL_NONE;
}

static enum refusal serve_publish(struct asked *asked)
{
	struct nameless *nameless = asked->nameless;
	struct publications *all = &nameless->publications;
	const uint32_t period_us = wire_u32(&asked->frame.body);
	const uint8_t what = wire_u8(&asked->frame.body);
	struct publish_set *set;
	uint32_t count;
	enum refusal refusal;

	if (what != PUBLISH_VARIABLES) /* the cells of a POU have names */
		return asked->frame.body.failed || what != PUBLISH_CELLS ? REFUSAL_BAD_FRAME :
									   REFUSAL_NO_NAMES;
	refusal = take_items(asked, false, &count);
	if (refusal != REFUSAL_NONE)
		return refusal;
	set = publish_new(all, asked->frame.request, period_us);
	if (!set)
		return REFUSAL_TOO_MANY;
	for (uint32_t i = 0; i < count; i++)
		if (!publish_add(all, set, nameless->place[i])) {
			publish_drop(all, asked->frame.request);
			return REFUSAL_TOO_MANY;
		}
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, count);
	for (uint32_t i = 0; i < count; i++)
		wire_put_u8(&asked->out, (uint8_t)nameless->place[i].type);
	return REFUSAL_NONE;
}

static enum refusal serve_unpublish(struct asked *asked)
{
	const uint16_t request = wire_u16(&asked->frame.body);

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	publish_drop(&asked->nameless->publications, request);
	begin_answer(asked, 0);
	return REFUSAL_NONE;
}

/* ---- changes ---- */

/* Nothing is changed unless all of it can be. */
static enum refusal check_items(struct asked *asked, uint32_t count)
{
	const struct nameless *nameless = asked->nameless;
	const struct image *image = &nameless->cycle->resource.image;
	const uint8_t service = asked->row->number;
	uint32_t fresh = 0;

	asked->detail = asked->text;
	for (uint32_t i = 0; i < count; i++) {
		const struct location at = nameless->place[i];
		const bool forced = image_is_forced(image, at);

		place_address(image->program, at, asked->text, sizeof(asked->text));
		if (at.constant)
			return REFUSAL_CONSTANT;
		if (service == SERVICE_FORCE && at.type == IEC_STRING)
			return REFUSAL_NO_FORCE;
		if (service == SERVICE_UNFORCE && !forced)
			return REFUSAL_NOT_FORCED;
		fresh += !forced;
	}
	asked->detail = "";
	return service == SERVICE_FORCE && fresh > LIMIT_FORCES - (uint32_t)image->force_count ?
		       REFUSAL_TOO_MANY : REFUSAL_NONE;
}

static void change_items(struct nameless *nameless, uint8_t service, uint32_t count)
{
	struct image *image = &nameless->cycle->resource.image;

	for (uint32_t i = 0; i < count; i++)
		if (service == SERVICE_WRITE)
			image_set(image, nameless->place[i], nameless->value[i]);
		else if (service == SERVICE_FORCE)
			image_force(image, nameless->place[i], nameless->value[i]);
		else
			image_unforce(image, nameless->place[i]);
	while (service == SERVICE_UNFORCE && !count && image->force_count)
		image_unforce(image, image->force[image->force_count - 1].at);
}

static enum refusal serve_change(struct asked *asked)
{
	struct nameless *nameless = asked->nameless;
	const struct expect expect = wire_expect(&asked->frame.body);
	const uint8_t service = asked->row->number;
	uint32_t count;
	enum refusal refusal = take_items(asked, service != SERVICE_UNFORCE, &count);

	if (refusal == REFUSAL_NONE && nameless->role < ROLE_ENG)
		refusal = REFUSAL_EXPORTED;
	if (refusal == REFUSAL_NONE && !is_expected(asked, &expect))
		refusal = REFUSAL_CONFLICT;
	if (refusal == REFUSAL_NONE)
		refusal = check_items(asked, count);
	if (refusal == REFUSAL_NONE)
		change_items(nameless, service, count);
	return answer_scan(asked, refusal, nameless->cycle->resource.scans);
}

static enum refusal serve_forces(struct asked *asked)
{
	const struct image *image = &asked->nameless->cycle->resource.image;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	begin_answer(asked, 0);
	wire_put_u16(&asked->out, (uint16_t)image->force_count);
	for (int i = 0; i < image->force_count; i++) {
		const struct force *force = &image->force[i];

		place_address(image->program, force->at, asked->text, sizeof(asked->text));
		wire_put_u32(&asked->out, place_word(image->program, force->at));
		wire_put_string(&asked->out, asked->text);
		wire_put_u8(&asked->out, (uint8_t)force->at.type);
		wire_put_value(&asked->out, force->at.type, force->value);
		wire_put_value(&asked->out, force->at.type, force->aside);
	}
	return REFUSAL_NONE;
}

static enum refusal serve_mode(struct asked *asked)
{
	struct cycle *cycle = asked->nameless->cycle;
	const struct expect expect = wire_expect(&asked->frame.body);
	const enum mode_wish wish = (enum mode_wish)wire_u8(&asked->frame.body);
	const uint64_t scan = cycle->resource.scans;
	enum refusal refusal;

	if (!wire_done(&asked->frame.body) || wish >= MODE_COUNT)
		return REFUSAL_BAD_FRAME;
	if (wish != MODE_RESET && asked->nameless->role < ROLE_ENG)
		return refuse_role(asked, ROLE_ENG);
	if (!is_expected(asked, &expect))
		return REFUSAL_CONFLICT;
	refusal = cycle_mode(cycle, wish);
	if (refusal == REFUSAL_NOT_NOW)
		return not_now(asked, mode_wish_word(wish), mode_wish_needs(wish));
	return answer_scan(asked, refusal, scan);
}

/* ---- download ---- */

/* Whether a download may go on: hashing and storing would make scans late. */
static enum refusal can_download(struct asked *asked, bool begun)
{
	const struct nameless *nameless = asked->nameless;

	if (!nameless->download.pool)
		return REFUSAL_NO_STORE;
	if (nameless->cycle->resource.state == STATE_RUN)
		return not_now(asked, "download", STATE_STOP);
	return begun && !nameless->download.begun ? REFUSAL_NO_DOWNLOAD : REFUSAL_NONE;
}

static enum refusal serve_download(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	struct nameless_download *download = &asked->nameless->download;
	struct stored wanted = { .bytes = NULL };
	const enum refusal refusal = can_download(asked, false);
	const uint8_t *sha;

	for (int i = 0; i < STORED_PARTS; i++)
		wanted.len[i] = wire_u32(in);
	sha = wire_bytes(in, 32);
	if (!wire_done(in))
		return REFUSAL_BAD_FRAME;
	if (refusal != REFUSAL_NONE)
		return refusal;
	if (!stored_size(&wanted) || stored_size(&wanted) > NAMELESS_MOST) {
		snprintf(asked->text, sizeof(asked->text), "%u bytes at most", NAMELESS_MOST);
		asked->detail = asked->text;
		return REFUSAL_TOO_MANY;
	}
	wanted.bytes = download->pool + SLOT_HEAD;
	if (memcmp(download->sha, sha, 32) != 0 ||
	    memcmp(download->wanted.len, wanted.len, sizeof(wanted.len)) != 0)
		download->received = 0;
	download->wanted = wanted;
	memcpy(download->sha, sha, 32);
	download->begun = true;
	download->verified = false;
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, download->received);
	return REFUSAL_NONE;
}

static bool is_whole(const struct nameless_download *download)
{
	struct digest_sha256 sha;
	uint8_t hash[32];

	if (download->received != stored_size(&download->wanted))
		return false;
	digest_sha256_init(&sha);
	digest_sha256_add(&sha, download->wanted.bytes, download->received);
	digest_sha256_end(&sha, hash);
	return memcmp(hash, download->sha, 32) == 0;
}

/* The first error, as "LD607: …". */
static void say_error(struct asked *asked, const struct load *load)
{
	const struct diag_list *lists[] = { &load->source.diags, &load->diags };
	char text[256];

	for (int i = 1; i >= 0; i--)
		for (int k = 0; k < lists[i]->count; k++) {
			if (diag_severity(lists[i]->diag[k].id) != SEVERITY_ERROR)
				continue;
			diag_print(&lists[i]->diag[k], text, sizeof(text));
			snprintf(asked->text, sizeof(asked->text), "%.119s", text);
			asked->detail = asked->text;
		}
}

static enum refusal verify(struct asked *asked, uint8_t identity[32])
{
	const struct stored *stored = &asked->nameless->download.wanted;
	struct load *load = calloc(1, sizeof(*load));
	bool good;

	if (!load)
		return REFUSAL_MEMORY;
	good = load_texts(load, stored_part(stored, STORED_IMAGE), stored->len[STORED_IMAGE],
			  (const char *)stored_part(stored, STORED_MAP), stored->len[STORED_MAP]);
	if (good)
		code_identity(&load->source.program, identity);
	else
		say_error(asked, load);
	load_free(load);
	free(load);
	return good ? REFUSAL_NONE : REFUSAL_INVALID;
}

/* What does not go on is not known without names; the board begins again anyway. */
static enum refusal serve_verify(struct asked *asked)
{
	struct nameless_download *download = &asked->nameless->download;
	uint8_t identity[32];
	enum refusal refusal = can_download(asked, true);

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (refusal == REFUSAL_NONE && !is_whole(download)) {
		download->received = 0;
		refusal = REFUSAL_NOT_WHOLE;
	}
	if (refusal == REFUSAL_NONE)
		refusal = verify(asked, identity);
	if (refusal != REFUSAL_NONE)
		return refusal;
	download->verified = true;
	begin_answer(asked, 0);
	wire_put_u8(&asked->out, MAP_RESTART);
	wire_put_bytes(&asked->out, identity, sizeof(identity));
	wire_put_u32(&asked->out, 0);
	wire_put_u32(&asked->out, 0);
	return REFUSAL_NONE;
}

static enum refusal store(struct asked *asked)
{
	const struct nameless_download *download = &asked->nameless->download;
	struct slots *slots = asked->nameless->slots;
	struct diag_list *diags = calloc(1, sizeof(*diags));
	uint8_t beside[32];
	bool good = false;

	if (!diags)
		return REFUSAL_MEMORY;
	diag_init(diags);
	slots_beside(slots, beside);
	slot_seal(&download->wanted, slots->seq + 1, beside, download->pool);
	good = slots_store(slots, download->pool, SLOT_HEAD + (size_t)download->received + 4,
			   diags) && slots_keep(slots);
	if (!good) {
		slots_drop(slots);
		snprintf(asked->text, sizeof(asked->text), "%.100s", diags->count ? diags->diag[0].arg : slots->why);
		asked->detail = asked->text;
	}
	free(diags);
	return good ? REFUSAL_NONE : REFUSAL_DISK;
}

/* Another program always begins anew: to carry values over, names are needed. */
static enum refusal serve_commit(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	struct cycle *cycle = asked->nameless->cycle;
	const struct expect expect = wire_expect(in);
	const uint8_t how = wire_u8(in);
	const uint32_t back = wire_left(in) ? wire_u32(in) : 0;
	enum refusal refusal = can_download(asked, true);

	if (!wire_done(in) || how >= COMMIT_COUNT || (how != COMMIT_LIVE && back))
		return REFUSAL_BAD_FRAME;
	if (how == COMMIT_LIVE)
		return REFUSAL_NO_SERVICE;
	if (refusal == REFUSAL_NONE && !asked->nameless->download.verified)
		refusal = REFUSAL_NO_DOWNLOAD;
	if (refusal == REFUSAL_NONE && !is_expected(asked, &expect))
		refusal = REFUSAL_CONFLICT;
	if (refusal == REFUSAL_NONE)
		refusal = store(asked);
	if (refusal == REFUSAL_NONE) {
		cycle->restart_stopped = how == COMMIT_STOPPED;
		cycle->restart = true;
		control_tell("begins again with the program of a desk");
	}
	return answer_scan(asked, refusal, cycle->resource.scans);
}

static enum refusal serve_abort(struct asked *asked)
{
	struct nameless_download *download = &asked->nameless->download;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	if (!download->begun)
		return REFUSAL_NO_DOWNLOAD;
	download->begun = download->verified = false;
	begin_answer(asked, 0);
	return REFUSAL_NONE;
}

/* ---- requests ---- */

static enum refusal serve_hello(struct asked *asked)
{
	struct wire_reader *in = &asked->frame.body;
	const uint32_t magic = wire_u32(in);
	const uint16_t lowest = wire_u16(in), highest = wire_u16(in);
	size_t len;

	wire_text(in, &len); /* the name of the desk's program */
	if (in->failed || magic != ONLINE_MAGIC)
		return REFUSAL_BAD_FRAME;
	if (lowest > ONLINE_HIGHEST || highest < ONLINE_LOWEST)
		return REFUSAL_VERSION;
	asked->nameless->greeted = true;
	begin_answer(asked, 0);
	wire_put_u32(&asked->out, ONLINE_MAGIC);
	wire_put_u16(&asked->out, highest < ONLINE_HIGHEST ? highest : ONLINE_HIGHEST);
	wire_put_u8(&asked->out, (uint8_t)asked->nameless->role);
	wire_put_u8(&asked->out, 0);
	wire_put_string(&asked->out, LADDER_VERSION);
	wire_put_string(&asked->out, cycle_board(asked->nameless->cycle));
	return REFUSAL_NONE;
}

/* The fields of the status that no scan gives. */
static void amend_status(const struct nameless *nameless, struct board_status *status)
{
	struct timespec now;
	struct rusage used;
	int64_t up_us, busy_us;

	status->sessions = 1;
	clock_gettime(CLOCK_MONOTONIC, &now);
	up_us = now.tv_sec * INT64_C(1000000) + now.tv_nsec / 1000 - nameless->began_ns / 1000;
	status->up_ms = (uint64_t)up_us / 1000;
	if (getrusage(RUSAGE_SELF, &used) != 0)
		return;
	busy_us = (used.ru_utime.tv_sec + used.ru_stime.tv_sec) * INT64_C(1000000) +
		  used.ru_utime.tv_usec + used.ru_stime.tv_usec;
	status->cpu_permille = (uint32_t)(up_us > 0 ? busy_us * 1000 / up_us : 0);
	status->memory_bytes = (uint64_t)used.ru_maxrss * 1024;
}

static enum refusal serve_status(struct asked *asked)
{
	struct board_status *status = &asked->nameless->status;

	if (!wire_done(&asked->frame.body))
		return REFUSAL_BAD_FRAME;
	memset(status, 0, sizeof(*status));
	control_fill_status(asked->nameless->cycle, status);
	amend_status(asked->nameless, status);
	begin_answer(asked, 0);
	status_put(&asked->out, status);
	return REFUSAL_NONE;
}

static enum refusal serve(struct asked *asked)
{
	switch (asked->row->number) {
	case SERVICE_HELLO:
		return serve_hello(asked);
	case SERVICE_STATUS:
		return serve_status(asked);
	case SERVICE_SYMBOLS:
		return REFUSAL_NO_NAMES;
	case SERVICE_READ:
		return serve_read(asked);
	case SERVICE_PUBLISH:
		return serve_publish(asked);
	case SERVICE_UNPUBLISH:
		return serve_unpublish(asked);
	case SERVICE_WRITE: case SERVICE_FORCE: case SERVICE_UNFORCE:
		return serve_change(asked);
	case SERVICE_FORCES:
		return serve_forces(asked);
	case SERVICE_MODE:
		return serve_mode(asked);
	case SERVICE_DOWNLOAD:
		return serve_download(asked);
	case SERVICE_VERIFY:
		return serve_verify(asked);
	case SERVICE_COMMIT:
		return serve_commit(asked);
	case SERVICE_ABORT:
		return serve_abort(asked);
	default:
		return REFUSAL_NO_SERVICE;
	}
}

static bool is_change(uint8_t service)
{
	return service == SERVICE_WRITE || service == SERVICE_FORCE ||
	       service == SERVICE_UNFORCE || service == SERVICE_MODE || service == SERVICE_COMMIT;
}

/* Gives the answer of the same request again; it is not done again. */
static bool repeat(struct nameless *nameless, const struct frame *frame)
{
	for (int i = 0; i < NAMELESS_KEPT; i++) {
		const struct nameless_kept *kept = &nameless->kept[i];

		if (!kept->number || kept->request != frame->request ||
		    kept->service != frame->service ||
		    nameless->requests - kept->number > KEPT_FOR)
			continue;
		memcpy(nameless->out, kept->bytes, kept->len);
		nameless->out_len = kept->len;
		return true;
	}
	return false;
}

static void keep(struct nameless *nameless, const struct frame *frame)
{
	struct nameless_kept *oldest = &nameless->kept[0];

	for (int i = 1; i < NAMELESS_KEPT; i++)
		if (nameless->kept[i].number < oldest->number)
			oldest = &nameless->kept[i];
	if (nameless->out_len > NAMELESS_ANSWER)
		return;
	oldest->number = nameless->requests;
	oldest->request = frame->request;
	oldest->service = frame->service;
	oldest->len = (uint16_t)nameless->out_len;
	memcpy(oldest->bytes, nameless->out, nameless->out_len);
}

static enum refusal judge(struct asked *asked)
{
	const struct nameless *nameless = asked->nameless;

	if (!asked->row)
		return REFUSAL_NO_SERVICE;
	if (!nameless->greeted && asked->row->number != SERVICE_HELLO)
		return REFUSAL_NO_HELLO;
	if (nameless->role < asked->row->role)
		return refuse_role(asked, asked->row->role);
	return REFUSAL_NONE;
}

/* @refusal: of a request that was not kept. */
static void answer(struct nameless *nameless, const struct frame *frame, enum refusal refusal)
{
	struct asked asked = { .nameless = nameless, .frame = *frame, .detail = "",
			       .row = service_row(frame->service) };
	const bool change = is_change(frame->service);

	nameless->requests++;
	if (change && repeat(nameless, frame))
		return;
	if (refusal == REFUSAL_NONE)
		refusal = judge(&asked);
	if (refusal == REFUSAL_NONE && frame->service != SERVICE_BLOCK)
		refusal = serve(&asked);
	else if (refusal == REFUSAL_NONE) {
		begin_answer(&asked, 0);
		wire_put_u32(&asked.out, nameless->download.received);
	}
	if (refusal == REFUSAL_NONE && asked.out.failed)
		refusal = REFUSAL_TOO_MANY;
	if (refusal != REFUSAL_NONE)
		refuse(&asked, refusal);
	nameless->out_len = frame_end(&asked.out);
	if (change)
		keep(nameless, frame);
}

/* ---- bytes ---- */

void nameless_begin(struct nameless *nameless)
{
	nameless->greeted = nameless->over = false;
	nameless->download.begun = nameless->download.verified = false; /* what has come stays */
	nameless->requests = 0;
	nameless->left = 0;
	nameless->in_len = nameless->out_len = nameless->out_sent = 0;
	memset(nameless->kept, 0, sizeof(nameless->kept));
	publish_init(&nameless->publications);
}

bool nameless_take(struct nameless *nameless, const uint8_t *bytes, size_t len)
{
	if (nameless->over || len > sizeof(nameless->in) - nameless->in_len)
		return false;
	memcpy(nameless->in + nameless->in_len, bytes, len);
	nameless->in_len += len;
	return true;
}

static void drop(struct nameless *nameless, size_t len)
{
	nameless->in_len -= len;
	memmove(nameless->in, nameless->in + len, nameless->in_len);
}

/* The rest of a frame that is longer than `in`: bytes of a program, or of no use. */
static bool pass_on(struct nameless *nameless)
{
	struct nameless_download *download = &nameless->download;
	const uint32_t len = nameless->in_len < nameless->left ? (uint32_t)nameless->in_len :
								 nameless->left;
	const struct frame frame = { .service = nameless->service, .request = nameless->request };

	if (nameless->refusal == REFUSAL_NONE) {
		memcpy(download->pool + SLOT_HEAD + nameless->at, nameless->in, len);
		nameless->at += len;
		download->received = nameless->at;
	}
	drop(nameless, len);
	nameless->left -= len;
	if (!nameless->left)
		answer(nameless, &frame, nameless->refusal);
	return len > 0;
}

/* A block goes on where the one before ended. It is refused before a byte is taken. */
static enum refusal can_take_block(const struct nameless *nameless, uint32_t offset, uint32_t len)
{
	const struct nameless_download *download = &nameless->download;

	if (!len)
		return REFUSAL_BAD_FRAME;
	if (!download->pool)
		return REFUSAL_NO_STORE;
	if (!nameless->greeted || nameless->role < ROLE_ENG || !download->begun)
		return REFUSAL_NO_DOWNLOAD;
	return offset != download->received ||
	       len > stored_size(&download->wanted) - download->received ? REFUSAL_NOT_WHOLE :
									    REFUSAL_NONE;
}

/* A frame that is not kept begins. @length: bytes behind its length. */
static void begin_passing(struct nameless *nameless, uint32_t length, const struct frame *frame)
{
	struct wire_reader in = wire_read(nameless->in + WIRE_HEAD, 4);
	const bool block = frame->service == SERVICE_BLOCK;
	const uint32_t head = block ? BLOCK_HEAD : WIRE_HEAD;

	nameless->service = frame->service;
	nameless->request = frame->request;
	nameless->at = block ? wire_u32(&in) : 0;
	nameless->left = length + 4 - head;
	nameless->refusal = block ? can_take_block(nameless, nameless->at, nameless->left) :
				    REFUSAL_TOO_MANY;
	if (nameless->refusal == REFUSAL_NONE)
		nameless->download.verified = false;
	drop(nameless, head);
}

static bool give_up(struct nameless *nameless)
{
	struct asked asked = { .nameless = nameless, .detail = "the length of a frame" };

	refuse(&asked, REFUSAL_BAD_FRAME);
	nameless->out_len = frame_end(&asked.out);
	nameless->over = true;
	return true;
}

/* The next request, if it is whole or its bytes need not be kept. */
static bool serve_next(struct nameless *nameless)
{
	struct wire_reader in = wire_read(nameless->in, nameless->in_len);
	const uint32_t length = wire_u32(&in);
	struct frame frame = { .service = wire_u8(&in) };
	size_t used;

	frame.flags = wire_u8(&in);
	frame.request = wire_u16(&in);
	if (nameless->in_len < WIRE_HEAD)
		return nameless->in_len >= 4 && (length < WIRE_HEAD - 4 ||
						 length > WIRE_FRAME_MOST - 4) && give_up(nameless);
	if (length >= WIRE_HEAD - 4 && length <= WIRE_FRAME_MOST - 4 &&
	    ((frame.service == SERVICE_BLOCK && length > BLOCK_HEAD - 4) ||
	     length + 4 > sizeof(nameless->in))) {
		if (nameless->in_len < BLOCK_HEAD)
			return false;
		begin_passing(nameless, length, &frame);
		return true;
	}
	switch (frame_next(nameless->in, nameless->in_len, &frame, &used)) {
	case FRAME_PART:
		return false;
	case FRAME_BAD:
		return give_up(nameless);
	case FRAME_GOOD:
		break;
	}
	answer(nameless, &frame, frame.service == SERVICE_BLOCK ? REFUSAL_BAD_FRAME : REFUSAL_NONE);
	drop(nameless, used);
	return true;
}

static void publish_next(struct nameless *nameless, int64_t now_ns)
{
	struct resource *resource = &nameless->cycle->resource;
	const struct view view = {
		.scan = resource->scans, .now_ns = resource->vm.now_ns, .state = resource->state,
		.io_bad = resource->io_fault, .memory = resource->image.memory,
	};
	struct wire_writer out = wire_write(nameless->out, sizeof(nameless->out));

	if (publish_due(&nameless->publications) > now_ns)
		return;
	if (nameless->out_len)
		publish_lose(&nameless->publications, now_ns);
	else
		nameless->out_len = publish_write(&nameless->publications, &view,
						  &resource->image, now_ns, &out);
}

bool nameless_step(struct nameless *nameless, int64_t now_ns)
{
	bool more = false;

	if (!nameless->over && !nameless->out_len)
		more = nameless->left ? pass_on(nameless) : serve_next(nameless);
	if (!nameless->over)
		publish_next(nameless, now_ns);
	return more;
}

const uint8_t *nameless_pending(const struct nameless *nameless, size_t *len)
{
	*len = nameless->out_len - nameless->out_sent;
	return nameless->out + nameless->out_sent;
}

void nameless_sent(struct nameless *nameless, size_t len)
{
	nameless->out_sent += len;
	if (nameless->out_sent == nameless->out_len)
		nameless->out_len = nameless->out_sent = 0;
}
