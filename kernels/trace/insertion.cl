// A stack whose top is the nearest: pushes keep what one node adds in order.
#ifndef NOOK_INSERTION_CL
#define NOOK_INSERTION_CL

// Moves those of the places [first, place) that are entered before `enter` up by one, and leaves in `place` the one that is free then.
// `entry`: at what distance each is entered, the nearest on top. MOVE(to, from) moves what else the stack has of a place.
#define INSERT_BY_ENTRY(place, first, entry, enter, MOVE)                \
  for (; (place) > (first) && (entry)[(place)-1] < (enter); --(place)) { \
    MOVE((place), (place)-1)                                             \
    (entry)[place] = (entry)[(place)-1];                                 \
  }                                                                      \
  (entry)[place] = (enter);

#endif
