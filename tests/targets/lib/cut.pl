#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# cut - boots a machine again and again and cuts its power at a random moment.
#
#   cut.pl NAME CUTS DISK SOCKET LOG EMULATOR...
#
# The machine's disk is this program: QEMU asks it for each block (NBD). A write lies in the
# volatile cache of the disk until the machine flushes; only then it is on the disk for good. At
# the cut QEMU is killed (SIGKILL), so whatever its machine had not sent is gone, and of the
# writes in the cache each one, or each sector of it, or none reaches the disk, by chance, in an
# order of its own. That is what a disk may do that keeps what it promised: it lost nothing that
# was flushed. No cache of the host lies between: QEMU has none for NBD, and the disk is a
# string of this program. POWER_LIES=1 makes the disk lie: flushed writes are lost, too. Then
# the test must fail, which shows that the cuts are true.
#
# Three of four cuts come just behind a write, so that the cache is not empty.
#
# What the machine tells on its serial line before the cut is what was acknowledged.
use strict;
use warnings;
no warnings qw(portable); # numbers of 64 bits
use IO::Socket::UNIX;
use IO::Select;
use Time::HiRes qw(time);

$| = 1;
my ($name, $cuts, $path, $socket, $log, @emulator) = @ARGV;
my $lies = $ENV{POWER_LIES};
my $seed = $ENV{POWER_SEED} || time ^ $$;
srand $seed;
my $began = time;

open my $in, '<:raw', $path or die "$path: $!\n";
my $disk = do { local $/; <$in> };
close $in;
my $view = $disk;                      # what the machine reads: with its cache
my @cache;                             # [offset, bytes, for good]
my ($flushes, $writes, $lost, $kept) = (0, 0, 0, 0);

sub settle { # all writes so far are on the disk
	$flushes++;
	return if $lies;
	substr $disk, $_->[0], length $_->[1], $_->[1] for @cache;
	@cache = ();
}

sub lose { # the power goes
	my $how = int rand 4; # nothing is left; whole writes; sectors; all but the last ones
	my $until = $how == 3 ? int rand @cache + 1 : 0;
	my $n = 0;
	for my $write (@cache) {
		my ($at, $bytes, $good) = @$write;
		my $whole = $how == 1 ? rand() < 0.5 : $how == 3 ? $n < $until : 0;
		$n++;
		for (my $i = 0; $i < length $bytes; $i += 512) {
			my $stays = $good || $whole || ($how == 2 && rand() < 0.5);
			$stays ? $kept++ : $lost++;
			my $part = substr $bytes, $i, 512;
			substr $disk, $at + $i, length $part, $part if $stays;
		}
	}
	@cache = ();
	$view = $disk;
}

# ---- NBD, as its fixed newstyle says ----
my ($client, $buffer, $phase);
my $writes_left; # until the power goes; undef: it goes by the clock
sub reply { my ($bytes) = @_; print {$client} $bytes; $client->flush; }

sub greet { # one option
	return if length $buffer < 16;
	my ($magic, $option, $len) = unpack 'Q> N N', $buffer;
	return if length $buffer < 16 + $len;
	substr $buffer, 0, 16 + $len, '';
	if ($option == 6 || $option == 7) { # info, go
		reply(pack('Q> N N N', 0x3e889045565a9, $option, 3, 12) . pack 'n Q> n', 0, length $disk, 1 | 4 | 8);
		reply(pack 'Q> N N N', 0x3e889045565a9, $option, 1, 0);
		$phase = 'serve' if $option == 7;
	} else {
		reply(pack 'Q> N N N', 0x3e889045565a9, $option, 0x80000001, 0);
	}
	return 1;
}

sub serve { # one request
	return if length $buffer < 28;
	my ($magic, $flags, $type, $handle, $at, $len) = unpack 'N n n a8 Q> N', $buffer;
	my $with = $type == 1 ? $len : 0;
	return if length $buffer < 28 + $with;
	my $bytes = substr $buffer, 28, $with;
	substr $buffer, 0, 28 + $with, '';
	my $good = pack 'N N a8', 0x67446698, 0, $handle;
	if ($type == 0) {
		reply($good . substr $view, $at, $len);
	} elsif ($type == 1) {
		$writes++;
		substr $view, $at, $len, $bytes;
		push @cache, [$at, $bytes, $flags & 1 && !$lies];
		reply($good);
		$phase = 'cut' if defined $writes_left && --$writes_left <= 0;
	} elsif ($type == 3) {
		settle();
		reply($good);
	} elsif ($type == 2) {
		$phase = 'gone';
	} else {
		reply(pack 'N N a8', 0x67446698, 22, $handle);
	}
	return 1;
}

sub served {
	my $got = sysread $client, $buffer, 1 << 20, length $buffer;
	return 0 if !$got;
	while (1) {
		if ($phase eq 'flags') {
			last if length $buffer < 4;
			substr $buffer, 0, 4, '';
			$phase = 'greet';
		}
		my $more = $phase eq 'greet' ? greet() : $phase eq 'serve' ? serve() : undef;
		last if !$more;
	}
	return 1;
}

# ---- a boot until its cut ----
my %stored = (retain => 0, slot => 0, event => 0); # the last acknowledged
my %most = %stored;                                # and the last that was there
my ($value, $said) = (0, '');
my @wrong;

sub heard {
	my ($line) = @_;
	if ($line =~ /^retain: copy (\d+)/ || $line =~ /^STORED retain (\d+)/) {
		$stored{retain} = $1 if $1 > $stored{retain};
	} elsif ($line =~ /^STORED (slot|event) (\d+)/) {
		$stored{$1} = $2 if $2 > $stored{$1};
	} elsif ($line =~ /^ON DISK (\w+) (\d+) (-?\d+)/) {
		my ($what, $seq, $more) = ($1, $2, $3);
		return push @wrong, "$what $seq is older than $stored{$what}, which was stored" if $seq < $stored{$what};
		if ($what eq 'retain') {
			push @wrong, 'retained values of two scans' if $more < 0;
			push @wrong, "the value $more is older than $value" if $more < $value;
			$value = $more if $more > $value;
		}
		push @wrong, "a stored program is damaged" if $what eq 'slot' && $more;
		$stored{$what} = $seq; # it is on the disk: from now on it must stay
	} elsif ($line =~ /^BROKEN|Kernel panic|all retained values are lost|I\/O error|EXT4-fs error|F2FS-fs.*(?:error|inconsist)/) {
		push @wrong, $line;
	}
}

sub boot {
	my ($until) = @_;
	unlink $socket;
	my $server = IO::Socket::UNIX->new(Local => $socket, Listen => 1) or die "$socket: $!\n";
	pipe my $console, my $write or die $!;
	my $pid = fork // die $!;
	if (!$pid) {
		open STDIN, '<', '/dev/null';
		open STDOUT, '>&', $write;
		open STDERR, '>&', $write;
		exec @emulator or die "exec: $!\n";
	}
	close $write;
	my $poll = IO::Select->new($server, $console);
	my ($text, $runs, $since) = ('', 0, time);
	undef $client;
	($buffer, $phase) = ('', 'flags');
	my $cut_at;
	undef $writes_left;
	while ($phase ne 'cut') {
		if (defined $cut_at && time >= $cut_at) {
			last if defined $writes_left || rand() < 0.25;
			$writes_left = 1 + int rand 12;
			$cut_at = time + 5; # if there are no more
		}
		last if time - $since > 300;
		my $wait = defined $cut_at ? $cut_at - time : 1;
		for my $ready ($poll->can_read($wait < 0 ? 0 : $wait > 1 ? 1 : $wait)) {
			if ($ready == $server) {
				$client = $server->accept;
				binmode $client;
				$poll->add($client);
				reply('NBDMAGIC' . pack 'Q> n', 0x49484156454f5054, 1 | 2);
			} elsif ($client && $ready == $client) {
				served() or $poll->remove($client);
			} else {
				my $got = sysread $console, $text, 65536, length $text;
				if (!$got) {
					push @wrong, 'the machine ended by itself';
					$phase = 'cut';
					last;
				}
				while ($text =~ s/^([^\n]*)\n//) {
					(my $line = $1) =~ s/\r//g;
					print {$main::out} "$line\n";
					heard($line);
					$cut_at = time + $until->[1] if $line eq 'MOUNTED' && $until->[0] eq 'mounted';
					$runs ||= $line =~ /^retain: copy/;
					$cut_at = time + $until->[1] if !defined $cut_at && $runs;
				}
				$cut_at = time + $until->[1] if !defined $cut_at && $until->[0] eq 'booting' && $client;
			}
		}
	}
	push @wrong, 'the machine did not come up' if !defined $cut_at;
	kill 'KILL', $pid;
	waitpid $pid, 0;
	# What was on its way to the disk never came there; what the machine had told was told.
	close $client if $client;
	while (sysread $console, $text, 65536, length $text) { }
	heard($_) for map { s/\r//gr } split /(?<=\n)/, $text =~ s/[^\n]*\z//r;
	lose();
}

our $out;
open $out, '>', $log or die "$log: $!\n";
$out->autoflush(1);
my ($done, $bad) = (0, 0);
for my $cut (1 .. $cuts + 1) {
	@wrong = ();
	# Most cuts come while it works, some while it mounts and looks at what the last cut left.
	my $last = $cut == $cuts + 1; # only to see that it comes up
	boot($last ? ['running', 3] : rand() < 0.15 ? ['mounted', rand 0.3] : ['running', 0.2 + rand 5]);
	print {$out} "CUT $cut: retain $stored{retain}, slot $stored{slot}, event $stored{event}\n";
	# prove keeps back what goes to stdout
	printf STDERR "# power, %s: %d of %d cuts in %d s\n", $name, $cut, $cuts, time - $began
		if $cut % 10 == 0 || $cut == $cuts;
	next if !@wrong;
	$bad++;
	print "# $name, cut $cut: $_\n" for @wrong;
	last if $bad > 5;
}
printf "# %s: %d cuts (seed %s); %d writes, %d flushes; of the sectors in the cache %d were lost and %d not\n",
	$name, $cuts, $seed, $writes, $flushes, $lost, $kept;
print "# $name: copy $stored{retain}, download $stored{slot}, event $stored{event} at the end\n";
# A test that stored nothing, or lost nothing, has shown nothing.
exit($bad || !$stored{retain} || !$stored{slot} || !$lost ? 1 : 0);
