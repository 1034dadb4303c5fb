/* SPDX-License-Identifier: MIT
 *
 * wire - frames of the link between desk and board, and the fields in them.
 *
 * A frame is `u32 length | u8 service | u8 flags | u16 request | fields` (docs/online.md).
 * All numbers are little-endian, texts are counted, nothing is padded. A reader cannot read
 * past its end and a writer cannot write past its end: after the first attempt both have
 * failed and stay so. It opens nothing, allocates nothing, and does not know what fields
 * mean.
 */
#ifndef ONLINE_WIRE_H
#define ONLINE_WIRE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define WIRE_FRAME_MOST 65536u /* bytes of a frame with its length            */
#define WIRE_HEAD       8u     /* bytes before the fields                     */
#define WIRE_TEXT_MOST  1024u  /* bytes of a text                             */

struct wire_reader {
	const uint8_t *at, *end;
	bool failed;
};

/** wire_read - @len bytes, borrowed. Scan-safe: yes; so are all functions of this file. */
struct wire_reader wire_read(const void *bytes, size_t len);
/** wire_u8 … wire_i64 - the next number; 0 after a failure. */
uint8_t wire_u8(struct wire_reader *in);
uint16_t wire_u16(struct wire_reader *in);
uint32_t wire_u32(struct wire_reader *in);
uint64_t wire_u64(struct wire_reader *in);
int64_t wire_i64(struct wire_reader *in);
/** wire_bytes - the next @len bytes, borrowed. Fails: NULL. */
const uint8_t *wire_bytes(struct wire_reader *in, size_t len);
/** wire_text - a counted text, borrowed, not ended by NUL. Fails: "" with @len 0; also if it
 * is longer than WIRE_TEXT_MOST. */
const char *wire_text(struct wire_reader *in, size_t *len);
/** wire_copy_text - a counted text as one that ends with NUL, cut to @size bytes at
 * a whole UTF-8 character. */
void wire_copy_text(struct wire_reader *in, char *out, size_t size);
/** wire_left - bytes that were not read yet. */
size_t wire_left(const struct wire_reader *in);
/** wire_done - whether all bytes were read, and none too many. */
bool wire_done(const struct wire_reader *in);

struct wire_writer {
	uint8_t *start, *at, *end;
	bool failed;           /* a field had no room; the text is incomplete */
};

/** wire_write - into @size bytes of the caller. */
struct wire_writer wire_write(void *bytes, size_t size);
void wire_put_u8(struct wire_writer *out, uint8_t value);
void wire_put_u16(struct wire_writer *out, uint16_t value);
void wire_put_u32(struct wire_writer *out, uint32_t value);
void wire_put_u64(struct wire_writer *out, uint64_t value);
void wire_put_i64(struct wire_writer *out, int64_t value);
void wire_put_bytes(struct wire_writer *out, const void *bytes, size_t len);
/** wire_cut - the beginning of a text of @len bytes that fits into @size bytes with its NUL, in whole
 * characters of UTF-8. */
void wire_cut(char *out, size_t size, const char *text, size_t len);
/** wire_put_text - a counted text, cut at WIRE_TEXT_MOST bytes, before a character of UTF-8. */
void wire_put_text(struct wire_writer *out, const char *text, size_t len);
/** wire_put_string - the same of a NUL-ended one. */
void wire_put_string(struct wire_writer *out, const char *text);
/** wire_len - bytes written. */
size_t wire_len(const struct wire_writer *out);

enum wire_flag {
	WIRE_ANSWER = 1,   /* to a request, with its number                   */
	WIRE_REFUSED = 2,  /* beside it: a refusal (online/refusals.def)      */
	WIRE_TOLD = 4,     /* not asked for each time: values, events         */
};

struct frame {
	uint8_t service, flags;
	uint16_t request;
	struct wire_reader body;
};

enum frame_state {
	FRAME_GOOD,
	FRAME_PART,   /* more bytes must come                                 */
	FRAME_BAD,    /* a length that no frame has: the stream is useless    */
};

/**
 * frame_next - the frame at the beginning of @bytes
 * @used: gets its bytes, if it is whole
 */
enum frame_state frame_next(const uint8_t *bytes, size_t len, struct frame *out, size_t *used);
/** frame_begin - writes a head; the length is filled in by frame_end(). */
void frame_begin(struct wire_writer *out, uint8_t service, uint8_t flags, uint16_t request);
/** frame_end - closes a frame that frame_begin() began at the writer's start. Fails: 0: a field
 * had no room; else the bytes of the frame. */
size_t frame_end(struct wire_writer *out);
#endif
