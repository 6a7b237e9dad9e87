// Dumps in the form that Dump writes, used by several tests.
#pragma once

#include <string_view>

namespace ncport::ir::test {

/// Every kind of record, word, expression and function.
inline constexpr std::string_view kEverything = R"(ncport-ir 1
file main.mpf
file "with blank.spf"
file main.mpf
axis SP3
axis X
axis SP3
spelling G1 rule "8.2"
spelling G1 rule -
spelling DIAMON rule sinumerik-9
space R 0..299 real kept all zero
space # 1..33 number call level vacant
space R 1..2 int program program unknown
system $P_EP programmed-position real
system #3000 environment int writable number 3000
var GLOBAL int global at @-:0 0+3
var N real channel dims 3 4
var GLOBAL bool program
program MAIN main @main.mpf:3 header
  param ALLOW real parameter initial 0.5:real at @main.mpf:3 11+5
  param MODE int parameter ref lower 0:int upper 010:int
  var N string local length 20 definition 1 initial "abc":string
  var LIST real local dims 4 initial-list (1, vacant, 3.) at @main.mpf~2:4 9+4
  var LIST real local dims 2 3 4
  @main.mpf:3 : header MAIN {at 0+4}
  @main.mpf:5 indent 2 skip 1 N0010 label AGAIN skip-digit : motion linear {as G1 digits 2 at 5+3}; axis X = 10.50:real@9+5 {equal at 8+6}; axis SP3 absolute = add:real(variable:real ALLOW, -.5); axis X~2 incremental = 1; axis SP3~2 = +3
    ; own-line "a \"quoted\" \\ text\x0A"
    ; before-word word 2 gap 3 "speed"
    ; end-of-block ""
  @-
  @-:0 pass unroll added : inert 5 #7 = 0.
  @main.mpf:6 turn 3 pass unroll via @"with blank.spf":2 turn 1 via @main.mpf:1 N5 digits 0 main-block
  @main.mpf:7 link +2 : if = gt!tolerance!numeric-model:bool(cell:real R[1], literal(1000, as "1EX3"))
  @main.mpf:8 label "two words" refused : verbatim mark end-while "ENDWHILE X"
  @main.mpf:9 link +1 : else
  @main.mpf:10 link -3 : end-if
  @main.mpf:11 link +5 : while 2 = variable N
  @main.mpf:12 link +1 : loop
  @main.mpf:13 link -1 : end-loop
  @main.mpf:14 link +1 : repeat
  @main.mpf:15 link -1 : until = variable:bool GLOBAL~2
  @main.mpf:16 link -5 : end-while 2
  @main.mpf:17 link +1 : for variable MODE to 10:int step 2:int = 1:int
  @main.mpf:18 link -1 : end-for
  @main.mpf:20 : motion unknown; motion none; motion rapid; motion arc-cw; motion arc-ccw; motion arc-via; motion arc-tangent; motion thread; motion thread-increasing; motion thread-decreasing; motion tap-in; motion tap-out; motion tap-floating; motion probe
  @main.mpf:21 : plane unknown; plane xy; plane zx; plane yz; distance absolute; distance incremental; units mm; units inch; units mm-geometry; units inch-geometry
  @main.mpf:22 : feed-mode per-minute; feed-mode per-revolution; feed-mode inverse-time; speed-mode rpm {freezes}; speed-mode constant-surface; comp off; comp left; comp right
  @main.mpf:23 : diameter radius; diameter diameter {as DIAMON}; diameter diameter-absolute; path exact; path continuous; exact-once; return-level initial; return-level r-plane
  @main.mpf:24 : work-offset #54; work-offset #541 = 3; machine-coords; inert {as G1~2}; computed-g = cell # [100]; computed-m 2 = 5
  @main.mpf:25 : axis-computed absolute axis-name SP3 = 5; center I = 1; center J step = 2; center K absolute = 3; via I = 4; radius = -5; opening-angle = 90; turns = 2; polar-radius incremental = 4; polar-angle = 30
  @main.mpf:26 : chamfer length = 1; chamfer leg = 2; chamfer round = 3; chamfer round-modal = 0; contour-angle = 45; start-angle = 0; feed = 100; feed-once = 50 {phase motion}
  @main.mpf:27 : speed 2 = 800; speed-limit = 2500; spindle cw; spindle 2 positioned; spindle stop; spindle-position = 90; tool = "DRILL"; tool-change; edge = 1; tool-offset = 3; length-offset 1; length-offset = 5; radius-offset = 6; aux 3 = 41 {vanishes rounds}; aux-h = 7
  @main.mpf:28 : dwell-seconds = 2; dwell-revolutions 2 = 3; reference reference; reference second-reference; reference fixed-point; reference from-reference; pole last-position; pole workpiece-zero; pole last-pole
  @main.mpf:29 : frame translate; frame rotate; frame scale; frame mirror; frame add-translate; frame add-rotate; frame add-scale; frame add-mirror; frame reset; frame-angle = 30; frame-factor 1 = 2; preset-position; polar-mode 1; cycle drill; cycle-value level = 2; data-setting name - (0 L: 2)
  @main.mpf:30 : stop {phase before}; optional-stop; program-end #30; program-end; message = "done"; message 2:int = "shown"; message; print = "x"; alarm stops = 61000; alarm shows "text" = 65000; alarm by-number = 1; preprocess-stop; workpiece; workpiece name - brackets (0: -, 1: "CYLINDER")
  @main.mpf:31 : assign cell:real R[5] = 3; assign cell-at R~2[variable MODE] = 4; assign element N(1:int, 2:int) = 5; assign system $P_EP(axis-name X) = 6; assign-list place element LIST~2(0) (1, -, 3) repeat count 7; assign-list (-); define GLOBAL; extern SUB (int, string ref length 10, real dims 3 0); extern NOTHING (); file-mark
  @main.mpf:32 : when = 1:bool; skip-rest 2; jump forward label AGAIN = eq(1, 2); jump backward number 0 quiet; jump forward-then-backward main-number 100 +label ":100"; jump forward-then-from-start expression variable N; jump backward-then-forward program-start
  @main.mpf:33 : switch (1 => forward label A, 2 => backward label B, - => forward number 10) = variable MODE; switch () = 1; call name SUB brackets calls SUB (0: 1, 1: -, 2: variable ALLOW) passes 3; call text - by "SUB"; call block-range - same-level from label A to label B; call path "/_N_SPF/SUB"; call external X (0 A: 1.5, 1 ";": 2); call name SUB calls SUB~2
  @main.mpf:34 : modal-call name SUB (0: 5); modal-call; repeat-part first label A single = 2; repeat-part first label A last label B; repeat-part first number 5 or-end label ENDLABEL; return auxiliary; return plain; return to-caller = "L"; restart
  @main.mpf:35 : assign name X() = name Y(1, name Z()); assign variable N = vacant:number; assign variable N = convert!implicit!round-cut:int(group:real(5.0))
  @main.mpf:36 : assign variable N = plus(negate(not(bit-not(1)))); assign variable N = sub(mul(1, 2), div(3, idiv!operands-to-int(4, mod(5, 6))))
  @main.mpf:37 : assign variable N = ne!vacant-differs(lt(1, 2), le(3, ge!vacant-as-zero(4, 5))); assign variable N = and(or(1, 2), xor(bit-and(1, 2), bit-or(3, bit-xor(4, 5)))); assign variable N = concat("a":string, "b")
  @main.mpf:38 : assign variable N = call:real sin(call cos(call tan(1))); assign variable N = call asin(call acos(call atan(1))); assign variable N = call atan2(1, call atan2-positive(2, 3)); assign variable N = call sqrt(call abs(call square(call power(1, 2)))); assign variable N = call ln(call exp(call truncate(call round(call round-up(call round-away(call round-to-increment(1)))))))
  @main.mpf:39 : assign variable N = call min(1, call max(2, call bound(3, 4, call factorial(5)))); assign variable N = call from-bcd(call to-bcd(call add-decimal-point(call parameter(1, 2, 3, 4)))); assign variable N = call string-length(call to-upper(call to-lower("x"))); assign variable N = call index-of("a", "b"); assign variable N = call last-index-of("a", "b"); assign variable N = call index-of-any("a", "b"); assign variable N = call find("a", call substring("a", 1)); assign variable N = call parse-number(call to-text(1)); assign variable N = call is-number("1"); assign variable N = call format("%d", 1); assign variable N = call is-variable("N"); assign variable N = call axis-from-text(call axis-to-text(call is-axis("X"))); assign variable N = call asin-positive(1); assign variable N = call fixed-text(1, 4, 3)
  @main.mpf:40 : assign variable N = literal(0.1, computed); assign variable N = literal(255, as "H'FF'"); assign variable N = literal(1e+22, digits 1 0); assign variable N = literal(5); assign variable N = -0; assign variable N = 000.500; assign variable N = +.5; assign variable N = 5.
program SUB sub @"with blank.spf":1 saves-modal-state header library
  @"with blank.spf":2 : return plain
program SUB sub
program "%_N 1" sub
)";

}  // namespace ncport::ir::test
