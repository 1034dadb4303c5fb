/* SPDX-License-Identifier: MIT
 *
 * gateway - requests of a gateway, one at a time. Frames that were not asked for come while it waits or listens.
 */
#include "online/gateway.h"

#include "online/stored.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PUT_BYTES 14u /* of a value in io-put, at most                           */

static void take_outputs(struct gateway *gateway, struct wire_reader *in)
{
	uint16_t count;

	gateway->mode = wire_u8(in);
	gateway->held = wire_u8(in) != 0;
	count = wire_u16(in);
	for (uint32_t i = 0; i < count && !in->failed; i++) {
		const uint32_t point = wire_u32(in);
		enum iec_type type;
		union iec_value value;

		wire_u32(in); /* its serial */
		type = (enum iec_type)wire_u8(in);
		if (type == IEC_STRING)
			in->failed = true; /* no output is one */
		if (in->failed)
			return;
		value = wire_value(in, type, NULL);
		if (!in->failed && gateway->output)
			gateway->output(gateway->context, point, type, value);
	}
}

static void take_published(struct gateway *gateway, struct wire_reader *in)
{
	const uint8_t what = wire_u8(in);
	struct iec_text room;
	uint16_t count;

	wire_u8(in);  /* mode */
	wire_u64(in); /* scans */
	wire_i64(in); /* time */
	wire_u32(in); /* periods that were lost */
	count = wire_u16(in);
	for (uint32_t i = 0; i < count && what == 0 && !in->failed; i++) {
		const uint16_t which = wire_u16(in);
		const uint8_t quality = wire_u8(in);
		union iec_value value;

		if (in->failed || which >= gateway->published_count)
			return;
		value = wire_value(in, gateway->type[which], &room);
		if (!in->failed && gateway->published)
			gateway->published(gateway->context, which, gateway->type[which], value,
					   !(quality & VALUE_STALE));
	}
}

void gateway_told(struct gateway *gateway, const struct frame *frame)
{
	struct wire_reader in = frame->body;

	if (frame->service == SERVICE_COMMIT)
		gateway->changed = true;
	else if (gateway->changed)
		return; /* of the map before */
	else if (frame->service == SERVICE_IO_OUTPUTS && frame->request == gateway->outputs)
		take_outputs(gateway, &in);
	else if (frame->service == SERVICE_PUBLISH && frame->request == gateway->publish)
		take_published(gateway, &in);
}

static void take_told(void *context, const struct frame *frame)
{
	gateway_told(context, frame);
}

/* ---- begin and end ---- */

enum desk_end gateway_open(struct gateway *gateway, const char *socket, const char *program)
{
	const struct stream_where where = { .kind = STREAM_UNIX, .rest = socket };
	struct stream stream = { .fd = -1 };
	enum desk_end end;

	memset(gateway, 0, sizeof(*gateway));
	gateway->desk.stream.fd = -1;
	if (stream_open(&where, NULL, &stream) != 0)
		return DESK_GONE;
	end = desk_open_as(&gateway->desk, &stream, program, ROLE_IO);
	gateway->desk.told = take_told;
	gateway->desk.context = gateway;
	if (end != DESK_GOOD || gateway->desk.role == ROLE_IO)
		return end;
	gateway->desk.refusal = REFUSAL_ROLE;
	snprintf(gateway->desk.detail, sizeof(gateway->desk.detail), "%s" DIAG_AND "%s" DIAG_AND "%s",
		 service_row(SERVICE_IO_BEGIN)->word, role_word(ROLE_IO), role_word(gateway->desk.role));
	return DESK_REFUSED;
}

void gateway_close(struct gateway *gateway)
{
	desk_close(&gateway->desk);
	free(gateway->text);
	free(gateway->type);
	gateway->text = NULL;
	gateway->type = NULL;
}

int gateway_fd(const struct gateway *gateway)
{
	return gateway->desk.stream.fd;
}

static enum desk_end read_map(struct gateway *gateway, uint32_t size)
{
	uint32_t at = 0;

	free(gateway->text);
	gateway->text_len = 0;
	gateway->text = size <= STORED_MOST ? calloc(1, (size_t)size + 1) : NULL;
	if (!gateway->text)
		return DESK_NO_ROOM;
	while (at < size) {
		struct wire_writer out = desk_ask(&gateway->desk, SERVICE_IO_MAP);
		struct wire_reader in;
		enum desk_end end;
		const uint8_t *part;
		size_t len;

		wire_put_u32(&out, gateway->map);
		wire_put_u32(&out, at);
		end = desk_call(&gateway->desk, &out, &in);
		if (end != DESK_GOOD)
			return end;
		wire_u32(&in);
		len = wire_left(&in);
		part = wire_bytes(&in, len);
		if (!part || !len || len > size - at)
			return DESK_NONSENSE;
		memcpy(gateway->text + at, part, len);
		at += (uint32_t)len;
	}
	gateway->text_len = size;
	return DESK_GOOD;
}

static enum desk_end want_outputs(struct gateway *gateway)
{
	struct wire_writer out = desk_ask(&gateway->desk, SERVICE_IO_OUTPUTS);
	struct wire_reader in;

	wire_put_u32(&out, gateway->map);
	gateway->outputs = gateway->desk.request;
	return desk_call(&gateway->desk, &out, &in);
}

static void begin_put(struct gateway *gateway)
{
	gateway->put = wire_write(gateway->body, sizeof(gateway->body) - WIRE_HEAD - 6);
	gateway->waiting = 0;
}

enum desk_end gateway_begin(struct gateway *gateway, const char *driver)
{
	struct wire_writer out = desk_ask(&gateway->desk, SERVICE_IO_BEGIN);
	struct wire_reader in;
	enum desk_end end;
	uint32_t size;

	gateway->changed = false;
	gateway->outputs = gateway->publish = 0;
	gateway->published_count = 0;
	begin_put(gateway);
	wire_put_string(&out, driver);
	end = desk_call(&gateway->desk, &out, &in);
	if (end != DESK_GOOD)
		return end;
	gateway->changed = false; /* the message is older than the beginning */
	gateway->map = wire_u32(&in);
	size = wire_u32(&in);
	if (in.failed)
		return DESK_NONSENSE;
	end = read_map(gateway, size);
	return end == DESK_GOOD && gateway->output ? want_outputs(gateway) : end;
}

/* ---- values ---- */

enum desk_end gateway_put(struct gateway *gateway, uint32_t point, enum iec_type type,
			  union iec_value value, bool good)
{
	enum desk_end end = DESK_GOOD;

	if (gateway->put.end - gateway->put.at < (ptrdiff_t)PUT_BYTES || gateway->waiting == UINT16_MAX)
		end = gateway_flush(gateway);
	wire_put_u32(&gateway->put, point);
	wire_put_u8(&gateway->put, good);
	wire_put_u8(&gateway->put, (uint8_t)type);
	wire_put_value(&gateway->put, type, value);
	gateway->waiting++;
	return end;
}

enum desk_end gateway_flush(struct gateway *gateway)
{
	return gateway->waiting ? gateway_alive(gateway) : DESK_GOOD;
}

enum desk_end gateway_alive(struct gateway *gateway)
{
	struct wire_writer out;
	struct wire_reader in;

	out = desk_ask(&gateway->desk, SERVICE_IO_PUT);
	wire_put_u32(&out, gateway->map);
	wire_put_u16(&out, (uint16_t)gateway->waiting);
	if (gateway->waiting)
		wire_put_bytes(&out, gateway->body, wire_len(&gateway->put));
	begin_put(gateway);
	return desk_call(&gateway->desk, &out, &in);
}

enum desk_end gateway_listen(struct gateway *gateway, int ms)
{
	enum desk_end end = desk_listen(&gateway->desk, ms);

	while (end == DESK_GOOD)
		end = desk_listen(&gateway->desk, 0);
	return end == DESK_LATE ? DESK_GOOD : end;
}

/* ---- windows ---- */

static struct wire_writer ask_window(struct gateway *gateway, uint8_t what, uint32_t window,
				     uint32_t first, uint16_t count)
{
	struct wire_writer out = desk_ask(&gateway->desk, SERVICE_IO_WINDOW);

	wire_put_u8(&out, what);
	wire_put_u32(&out, gateway->map);
	wire_put_u32(&out, window);
	wire_put_u32(&out, first);
	wire_put_u16(&out, count);
	return out;
}

enum desk_end gateway_window_read(struct gateway *gateway, uint32_t window, uint32_t first,
				  uint16_t count, uint16_t *value)
{
	struct wire_writer out = ask_window(gateway, 0, window, first, count);
	struct wire_reader in;
	const enum desk_end end = desk_call(&gateway->desk, &out, &in);
	bool words;

	if (end != DESK_GOOD)
		return end;
	wire_u8(&in);  /* mode */
	wire_u64(&in); /* scans */
	words = wire_left(&in) == 2u * count;
	for (uint32_t i = 0; i < count; i++)
		value[i] = words ? wire_u16(&in) : wire_u8(&in);
	return wire_done(&in) ? DESK_GOOD : DESK_NONSENSE;
}

enum desk_end gateway_window_write(struct gateway *gateway, uint32_t window, bool coils, uint32_t first,
				   uint16_t count, const uint16_t *value)
{
	struct wire_writer out = ask_window(gateway, 1, window, first, count);
	struct wire_reader in;

	for (uint32_t i = 0; i < count; i++) {
		if (coils)
			wire_put_u8(&out, value[i] != 0);
		else
			wire_put_u16(&out, value[i]);
	}
	return desk_call(&gateway->desk, &out, &in);
}

/* ---- published variables, report ---- */

static enum desk_end take_types(struct gateway *gateway, struct wire_reader *in, uint32_t count)
{
	enum iec_type *type = calloc(count + 1, sizeof(*type));

	free(gateway->type);
	gateway->type = type;
	if (!type)
		return DESK_NO_ROOM;
	if (wire_u32(in) != count)
		return DESK_NONSENSE;
	for (uint32_t i = 0; i < count; i++) {
		type[i] = (enum iec_type)wire_u8(in);
		if (type[i] <= IEC_NONE || type[i] >= IEC_TYPE_COUNT)
			return DESK_NONSENSE;
	}
	gateway->published_count = count;
	return wire_done(in) ? DESK_GOOD : DESK_NONSENSE;
}

enum desk_end gateway_publish(struct gateway *gateway, const char *const *name, uint32_t count,
			      uint32_t every_us)
{
	struct wire_writer out = desk_ask(&gateway->desk, SERVICE_PUBLISH);
	struct wire_reader in;
	enum desk_end end;

	wire_put_u32(&out, every_us);
	wire_put_u8(&out, 0);
	wire_put_u16(&out, (uint16_t)count);
	for (uint32_t i = 0; i < count; i++)
		wire_put_name(&out, name[i]);
	gateway->publish = gateway->desk.request;
	gateway->published_count = 0;
	end = desk_call(&gateway->desk, &out, &in);
	return end == DESK_GOOD ? take_types(gateway, &in, count) : end;
}

enum desk_end gateway_report(struct gateway *gateway, const struct gateway_report *report)
{
	struct wire_writer out = desk_ask(&gateway->desk, SERVICE_IO_REPORT);
	struct wire_reader in;

	wire_put_u32(&out, gateway->map);
	report_put(&out, report);
	return desk_call(&gateway->desk, &out, &in);
}
