"""What is not known of a scene, and how sure its distance is for that."""
